#version 330 core
in vec3 position;
in vec2 coordinates;
uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
uniform float time;
uniform float height;
uniform float loose;
out vec3 facing;
out float sand;
out vec2 ripples;

void main()
{
}
