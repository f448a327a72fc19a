#version 410 core
// Doubles: vectors, matrices, square roots, fma, mix and comparisons.
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
  dmat3 m = dmat3(2.0); dvec3 q = m * dvec3(n); double z = sqrt(4.0lf * double(pv.w)) + fma(1.0lf, 2.0lf, 3.0lf);
  d *= float(length(q)) / 2.0 / float(length(dvec3(n))) * float(z) / 7.0 * float(mix(1.0lf, 3.0lf, 0.5lf)) / 2.0 * float(dot(q, q) > 3.0lf) * float(floor(2.5lf)) / 2.0;
  vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
  gl_Position = mc * pv;
}
