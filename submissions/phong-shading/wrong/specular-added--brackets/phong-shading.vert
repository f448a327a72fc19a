#version 410 core

layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

out vec4 position;
out vec3 normal;

void main(void)
{
  position = mw * pv;
  normal = normalize((mg * cv).xyz);
  gl_Position = mc * pv;
}
