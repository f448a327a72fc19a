#version 450

layout (location = 0) in vec4 pv;
in vec2 tv;
uniform mat4 mc;

layout (location = 2) smooth out float a;
layout (location = 1) noperspective out float b;
layout (location = 0) flat out float c;

void main(void)
{
  a = b = c = tv.x;
  gl_Position = mc * pv;
}
