#version 330 core
uniform vec3 eye, fogColour;
uniform float density;
in vec3 at;
out vec4 colour;
void main()
{
  colour = vec4(fogColour, 1.0);
}
