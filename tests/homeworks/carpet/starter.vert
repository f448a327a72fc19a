#version 330 core

in vec3 position;
in vec2 uv;
uniform mat4 model, camera;
uniform vec2 scroll;
out vec4 place;

void main()
{
    // Lay the cloth, and let it run.
    place = vec4(0.5, 0.5, 0.0, 1.0);
    gl_Position = camera * model * vec4(position, 1.0);
}
