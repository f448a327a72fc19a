#version 410 core
// Ten functions that call one another.
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
float f0(float x) { return x; }
float f1(float x) { return f0(x) + 1.0; }
float f2(float x) { return f1(x) + 1.0; }
float f3(float x) { return f2(x) + 1.0; }
float f4(float x) { return f3(x) + 1.0; }
float f5(float x) { return f4(x) + 1.0; }
float f6(float x) { return f5(x) + 1.0; }
float f7(float x) { return f6(x) + 1.0; }
float f8(float x) { return f7(x) + 1.0; }
float f9(float x) { return f8(x) + 1.0; }
void main()
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  float d = max(dot(n, l), 0.0);
  float s = pow(max(dot(n, h), 0.0), kshi);
  d *= f9(1.0) / 10.0;
  vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
  gl_Position = mc * pv;
}
