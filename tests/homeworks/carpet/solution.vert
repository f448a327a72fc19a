#version 330 core

in vec3 position;
in vec2 uv;
uniform mat4 model, camera;
uniform vec2 scroll;
out vec4 place;

void main()
{
    vec4 world = model * vec4(position, 1.0);
    vec4 cloth = vec4(uv * 1.5 - 0.25 + scroll, world.yz);
    vec4 clip = camera * world;
    place = cloth;
    gl_Position = clip;
}
