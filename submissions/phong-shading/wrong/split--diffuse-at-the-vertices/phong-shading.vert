#version 410 core

layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

out vec4 position;
out vec3 normal;
out float diffuse;
const vec4 pl = vec4(1.5, 1.0, -1.0, 1.0);

void main(void)
{
  position = mw * pv;
  normal = normalize((mg * cv).xyz);
  diffuse = max(dot(normal, normalize((pl * position.w - position * pl.w).xyz)), 0.0);
  gl_Position = mc * pv;
}
