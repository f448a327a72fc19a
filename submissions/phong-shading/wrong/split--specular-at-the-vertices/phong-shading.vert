#version 410 core

layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

out vec4 position;
out vec3 normal;
out float shine;
const vec4 pl = vec4(1.5, 1.0, -1.0, 1.0);

void main(void)
{
  position = mw * pv;
  normal = normalize((mg * cv).xyz);
  vec3 l = normalize(pl.xyz - position.xyz), v = normalize(-position.xyz);
  shine = pow(max(dot(normal, normalize(l + v)), 0.0), 24.0);
  gl_Position = mc * pv;
}
