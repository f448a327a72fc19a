#version 410 core
in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;
const vec4 pl = vec4(0, 0, 1, 0);
const vec4 lamb = vec4(vec3(1) / 5, 1);
const vec4 ldiff = vec4(1, 1, 1, 0);
const vec4 lspec = ldiff;
const vec4 kamb = vec4(3 / 5.0, 0, 0, 1);
const vec4 kdiff = kamb;
const vec4 kspec = vec4(2 * lamb.rgb, 1);
const int kshi = 80;
void main() {
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  float s = 1;
  for (int i = 0; i < kshi; ++i) s *= max(dot(n, h), 0);
  vc = kamb * lamb + max(dot(n, l), 0) * kdiff * ldiff + s * kspec * lspec;
  gl_Position = mc * pv;
}
