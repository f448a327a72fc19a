#version 410 core

layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

struct Point { vec4 position; vec3 normal; };
out Point at;
out vec4 spare[18];

void main(void)
{
  at.position = mw * pv;
  at.normal = normalize((mg * cv).xyz);
  for (int i = 0; i < 18; ++i) spare[i] = cv;
  gl_Position = mc * pv;
}
