#version 410 core

layout (location = 0) in vec4 pv;
in vec2 tv;
uniform mat4 mc;

smooth out float a;
noperspective out float b[2];
flat out float c;

void main(void)
{
  a = c = tv.x;
  b[0] = tv.x;
  b[1] = tv.y;
  gl_Position = mc * pv;
}
