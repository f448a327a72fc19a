#version 410 core

layout (location = 0) in vec4 pv;
in vec2 tv;
uniform mat4 mc;

#define HAND(how, name) how out float name
HAND(smooth, a);
HAND(noperspective, b);
HAND(flat, c);

void main(void)
{
  a = b = c = tv.x;
  gl_Position = mc * pv;
}
