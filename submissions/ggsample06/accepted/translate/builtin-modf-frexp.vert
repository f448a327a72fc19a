#version 410 core
// modf, frexp and ldexp of scalars and vectors, into swizzles and elements.
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;
in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

void main()
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  float d = max(dot(n, l), 0.0);
  float s = pow(max(dot(n, h), 0.0), kshi);
  vec3 w; ivec3 e; float a[2]; int i;
  vec3 r = modf(vec3(1.25, -2.5, 3.0) * pv.w, w);
  vec3 m = frexp(vec3(8.0, 0.75, -3.0) * pv.w, e);
  float g_ = modf(5.5 * pv.w, a[1]); float x = frexp(0.0 * pv.w, i);
  d *= float(r == vec3(0.25, -0.5, 0.0) && w == vec3(1.0, -2.0, 3.0) && m == vec3(0.5, 0.75, -0.75) && e == ivec3(4, 0, 2));
  d *= float(g_ == 0.5 && a[1] == 5.0 && x == 0.0 && i == 0) * ldexp(0.5, 4) / 8.0 * ldexp(vec2(1.0), ivec2(1, -1)).y * 2.0;
  vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
  gl_Position = mc * pv;
}
