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
  vec4 pos = mw * pv;
  vec3 N = normalize(mat3(mg) * cv.xyz);
  vec3 L = normalize(pl.xyz);
  vec3 V = normalize(-pos.xyz);
  vec3 H = normalize(L + V);
  vec4 a = lamb * kspec;
  vec4 d = ldiff * kdiff * max(dot(N, L), 0);
  vec4 s = lspec * kspec * pow(max(dot(N, H), 0), kshi);
  vc = a + d + s;
  gl_Position = mc * pv;
}
