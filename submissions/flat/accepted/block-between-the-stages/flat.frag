#version 410 core
in Face
{
  flat vec4 colour;
} given;
layout (location = 0) out vec4 fc;
void main(void)
{
  fc = given.colour;
}
