#version 410 core

layout (location = 0) in vec4 pv;
in vec2 tv;
uniform mat4 mc;

smooth out float a;
noperspective out float b;
flat out float c;

void main(void)
{
  a = b = c = tv.x;
  gl_Position = mc * pv;
}
