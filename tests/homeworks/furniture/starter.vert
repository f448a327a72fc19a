#version 330 core

in vec3 position, normal;
in vec4 tangent;
in vec2 uv;
uniform mat4 model, camera;
uniform mat3 normals;
uniform vec3 lamp;
out vec4 lit;

void main()
{
    // Light the furniture.
    lit = vec4(uv, 1.0, 1.0);
    gl_Position = camera * model * vec4(position, 1.0);
}
