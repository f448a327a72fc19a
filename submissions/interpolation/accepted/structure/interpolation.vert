#version 410 core

layout (location = 0) in vec4 pv;
in vec2 tv;
uniform mat4 mc;

smooth out float a;
noperspective out float b;
struct Last { vec2 uv; };
flat out Last c;

void main(void)
{
  a = tv.x;
  b = tv.x;
  c.uv = tv;
  gl_Position = mc * pv;
}
