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

vec3 unit(vec3 a) {
  float q = dot(a, a);
  if (q == 0) return vec3(0);
  return a * inversesqrt(q);
}

void main() {
  vec4 p = mw * pv;
  vec3 l = unit(p.w * pl.xyz - pl.w * p.xyz), v = unit(-p.xyz), n = unit(mat3(mg) * cv.xyz);
  vec3 h = unit(l + v);
  vec4 c = kamb * lamb;
  float nl = dot(n, l), nh = dot(n, h);
  if (!(nl <= 0)) c += nl * kdiff * ldiff;
  if (!(nh <= 0)) c += pow(nh, kshi) * kspec * lspec;
  if (isnan(c.r) || isinf(c.r)) c = kamb * lamb;
  vc = c;
  gl_Position = mc * pv;
}
