#version 410 core

layout (location = 0) in vec4 pv;
in vec2 tv;
uniform mat4 mc;

out int a;
noperspective out float b;
flat out float c;

void main(void)
{
  b = c = tv.x;
  a = int(8.0 * tv.x);
  gl_Position = mc * pv;
}
