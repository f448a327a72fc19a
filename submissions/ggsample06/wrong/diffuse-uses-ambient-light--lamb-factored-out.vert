#version 330
in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;
const vec4 pl = vec4(0, 0, 1, 0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1);
const vec4 ldiff = vec4(1, 1, 1, 0);
const vec4 lspec = vec4(1, 1, 1, 0);
const vec4 kamb = vec4(0.6, 0, 0, 1);
const vec4 kdiff = vec4(0.6, 0, 0, 1);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1);
const float kshi = 80;

void main() {
  vec4 p = mw * pv;
  vec3 n = normalize((mg * cv).xyz);
  vec3 l = pl.xyz;
  vec3 v = -normalize(p.xyz);
  vec3 h = (l + v) / length(l + v);
  float d = max(dot(n, l), 0);
  float s = pow(max(dot(n, h), 0), kshi);
  vc = (kamb + kdiff * d) * lamb + kspec * lspec * s;
  gl_Position = mc * pv;
}
