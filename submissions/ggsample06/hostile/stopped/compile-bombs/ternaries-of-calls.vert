#version 410 core
// Both sides of every choice are calls.
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;
layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;
float f0(float x) { return x > 0.0 ? sin(x) : cos(x); }
float f1(float x) { return x > 0.1 ? f0(x + 1.0) : f0(x - 1.0); }
float f2(float x) { return x > 0.2 ? f1(x + 1.0) : f1(x - 1.0); }
float f3(float x) { return x > 0.3 ? f2(x + 1.0) : f2(x - 1.0); }
float f4(float x) { return x > 0.4 ? f3(x + 1.0) : f3(x - 1.0); }
float f5(float x) { return x > 0.5 ? f4(x + 1.0) : f4(x - 1.0); }
float f6(float x) { return x > 0.6 ? f5(x + 1.0) : f5(x - 1.0); }
float f7(float x) { return x > 0.7 ? f6(x + 1.0) : f6(x - 1.0); }
float f8(float x) { return x > 0.8 ? f7(x + 1.0) : f7(x - 1.0); }
float f9(float x) { return x > 0.9 ? f8(x + 1.0) : f8(x - 1.0); }
float f10(float x) { return x > 0.10 ? f9(x + 1.0) : f9(x - 1.0); }
float f11(float x) { return x > 0.11 ? f10(x + 1.0) : f10(x - 1.0); }
void main(void)
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec + 0.0 * f11(n.x);
  gl_Position = mc * pv;
}
