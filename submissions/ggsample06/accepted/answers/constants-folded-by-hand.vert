#version 410 core

in vec4 pv;
in vec4 cv;
out vec4 vc;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

const vec3 light = vec3(0.0, 0.0, 1.0);

void main(void)
{
  vec3 v = -normalize((mw * pv).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(light + v);

  float d = max(dot(n, light), 0.0);
  float s = pow(max(dot(n, h), 0.0), 80.0);

  // 0.6 * 0.2 = 0.12
  vc = vec4(0.12, 0.0, 0.0, 1.0) + d * vec4(0.6, 0.0, 0.0, 0.0) + s * vec4(0.4, 0.4, 0.4, 0.0);
  gl_Position = mc * pv;
}
