#version 450

const float count = 6.0;

layout (location = 2) smooth in float red_;
layout (location = 1) noperspective in float green_;
layout (location = 0) flat in float blue_;

layout (location = 0) out vec4 fc;

float stripes(float c)
{
  return 0.5 - 0.5 * cos(6.2831853 * count * c);
}

void main(void)
{
  float red = stripes(red_);
  float green = stripes(green_);
  float blue = blue_;
  fc = vec4(red, green, blue, 1.0);
}
