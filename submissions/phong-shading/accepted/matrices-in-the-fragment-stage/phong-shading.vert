#version 410 core

layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mc;

out vec4 position;
out vec3 normal;

void main(void)
{
  position = pv;
  normal = cv.xyz;
  gl_Position = mc * pv;
}
