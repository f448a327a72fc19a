#version 410 core

layout (location = 0) in vec4 pv;
in vec2 tv;
uniform mat4 mc;

smooth out float a;
out vec2 b;
flat out float c;

void main(void)
{
  gl_Position = mc * pv;
  a = c = tv.x;
  b = vec2(tv.x, 1.0) * gl_Position.w * gl_Position.w;
}
