#version 410 core

layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

out vec4 position;
out vec3 normal;
out vec4 ambient;
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0), lamb = vec4(0.3, 0.3, 0.35, 1.0);

void main(void)
{
  position = mw * pv;
  normal = normalize((mg * cv).xyz);
  ambient = kamb * lamb;
  gl_Position = mc * pv;
}
