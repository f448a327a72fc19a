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
    vec4 world = model * vec4(position, 1.0);
    vec3 n = normalize(normals * normal);
    vec3 along = cross(n, mat3(model) * tangent.xyz) * tangent.w;
    float light = 0.25 + 0.5 * max(dot(n, normalize(lamp)), 0.0) + 0.2 * abs(along.y);
    vec4 surface = vec4(uv, light, 1.0);
    vec4 clip = camera * world;
    lit = surface;
    gl_Position = clip;
}
