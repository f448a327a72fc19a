#version 330 core
const float count = 6.0;

in Coordinates
{
  vec2 usual;
  noperspective vec2 screen;
  flat vec2 corner;
} i;
out vec4 fc;

float stripes(float c)
{
  float s = sin(3.14159265 * count * c);
  return s * s;
}

void main()
{
  fc = vec4(stripes(i.usual.x), stripes(i.screen.x), i.corner.x, 1.0);
}
