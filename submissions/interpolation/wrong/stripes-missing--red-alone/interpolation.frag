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
  return 0.5 - 0.5 * cos(6.2831853 * count * c);
}

void main()
{
  fc = vec4(i.usual.x, stripes(i.screen.x), i.corner.x, 1.0);
}
