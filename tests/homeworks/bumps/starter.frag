#version 330 core
uniform vec3 light;
uniform sampler2D paint, relief;
out vec4 colour;
void main()
{
  colour = vec4(0.5, 0.5, 0.5, 1.0);
}
