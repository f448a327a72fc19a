#version 330 core
in vec4 pv;
in vec2 tv;
uniform mat4 mc;

out Coordinates
{
  vec2 usual;
  noperspective vec2 screen;
  flat vec2 corner;
} o;

void main()
{
  gl_Position = mc * pv;
  o.usual = tv;
  o.screen = tv;
  o.corner = tv;
}
