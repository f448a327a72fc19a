#version 410 core

const float count = 6.0;

smooth in float a;
noperspective in float b;
flat in float c;

layout (location = 0) out vec4 fc;

float stripes(float c)
{
  return 0.5 - 0.5 * cos(6.2831853 * count * c);
}

void main(void)
{
  float red = stripes(a);
  float green = stripes(b * 2.0);
  float blue = c;
  fc = vec4(red, green, blue, 1.0);
}
