#version 410 core

layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

struct Point { vec4 position; vec3 normal; };
out Point at;

void main(void)
{
  at.position = mw * pv;
  at.normal = normalize((mg * cv).xyz);
  gl_Position = mc * pv;
}
