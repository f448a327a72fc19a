#version 410 core
// saturate, lerp, lambert and reflect as functions of the student.
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
float saturate(float x) { return clamp(x, 0.0, 1.0); }
float lerp(float a, float b, float t) { return a + (b - a) * t; }
float lambert(vec3 n, vec3 l) { return max(dot(n, l), 0.0); }
vec3 reflect(vec3 i, vec3 n) { return i - 2.0 * dot(n, i) * n; }
void main()
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  float d = max(dot(n, l), 0.0);
  float s = pow(max(dot(n, h), 0.0), kshi);
  d = saturate(lambert(n, l)); vec3 r = reflect(-l, n); d *= lerp(1.0, 0.0, 0.0) * step(-2.0, r.x);
  vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
  gl_Position = mc * pv;
}
