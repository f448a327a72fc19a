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
  float given[2] = float[](a, b);
  fc = vec4(0.0, 0.0, c, 1.0);
  for (int i = 0; i < 2; ++i)
    fc[i] = stripes(given[i]);
}
