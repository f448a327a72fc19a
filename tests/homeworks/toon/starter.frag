#version 330 core
struct Lamp { vec3 position; vec3 colour; };
uniform Lamp lamp;
uniform vec3 eye;
uniform int tones;
in vec3 at, facing;
out vec4 tint;
void main()
{
  tint = vec4(lamp.colour, 1.0);
}
