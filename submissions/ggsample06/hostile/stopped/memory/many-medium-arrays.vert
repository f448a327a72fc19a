#version 410 core
// Twenty arrays, each small enough.
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
void main(void)
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  float a0[200]; for (int i = 0; i < 200; i++) a0[i] = n.x * float(i);
  float a1[200]; for (int i = 0; i < 200; i++) a1[i] = n.x * float(i);
  float a2[200]; for (int i = 0; i < 200; i++) a2[i] = n.x * float(i);
  float a3[200]; for (int i = 0; i < 200; i++) a3[i] = n.x * float(i);
  float a4[200]; for (int i = 0; i < 200; i++) a4[i] = n.x * float(i);
  float a5[200]; for (int i = 0; i < 200; i++) a5[i] = n.x * float(i);
  float a6[200]; for (int i = 0; i < 200; i++) a6[i] = n.x * float(i);
  float a7[200]; for (int i = 0; i < 200; i++) a7[i] = n.x * float(i);
  float a8[200]; for (int i = 0; i < 200; i++) a8[i] = n.x * float(i);
  float a9[200]; for (int i = 0; i < 200; i++) a9[i] = n.x * float(i);
  float a10[200]; for (int i = 0; i < 200; i++) a10[i] = n.x * float(i);
  float a11[200]; for (int i = 0; i < 200; i++) a11[i] = n.x * float(i);
  float a12[200]; for (int i = 0; i < 200; i++) a12[i] = n.x * float(i);
  float a13[200]; for (int i = 0; i < 200; i++) a13[i] = n.x * float(i);
  float a14[200]; for (int i = 0; i < 200; i++) a14[i] = n.x * float(i);
  float a15[200]; for (int i = 0; i < 200; i++) a15[i] = n.x * float(i);
  float a16[200]; for (int i = 0; i < 200; i++) a16[i] = n.x * float(i);
  float a17[200]; for (int i = 0; i < 200; i++) a17[i] = n.x * float(i);
  float a18[200]; for (int i = 0; i < 200; i++) a18[i] = n.x * float(i);
  float a19[200]; for (int i = 0; i < 200; i++) a19[i] = n.x * float(i);
  float s = 0.0;
  for (int i = 0; i < 200; i++) s += a0[(i * 7) % 200] + a1[(i * 7) % 200] + a2[(i * 7) % 200] + a3[(i * 7) % 200] + a4[(i * 7) % 200] + a5[(i * 7) % 200] + a6[(i * 7) % 200] + a7[(i * 7) % 200] + a8[(i * 7) % 200] + a9[(i * 7) % 200] + a10[(i * 7) % 200] + a11[(i * 7) % 200] + a12[(i * 7) % 200] + a13[(i * 7) % 200] + a14[(i * 7) % 200] + a15[(i * 7) % 200] + a16[(i * 7) % 200] + a17[(i * 7) % 200] + a18[(i * 7) % 200] + a19[(i * 7) % 200];
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec + 0.0 * s;
  gl_Position = mc * pv;
}
