#version 410 core
// More attributes than there are.
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

in vec4 a0;
in vec4 a1;
in vec4 a2;
in vec4 a3;
in vec4 a4;
in vec4 a5;
in vec4 a6;
in vec4 a7;
in vec4 a8;
in vec4 a9;
in vec4 a10;
in vec4 a11;
in vec4 a12;
in vec4 a13;
in vec4 a14;
in vec4 a15;
in vec4 a16;
in vec4 a17;
in vec4 a18;
in vec4 a19;
in vec4 a20;
in vec4 a21;
in vec4 a22;
in vec4 a23;
in vec4 a24;
in vec4 a25;
in vec4 a26;
in vec4 a27;
in vec4 a28;
in vec4 a29;
in vec4 a30;
in vec4 a31;
in vec4 a32;
in vec4 a33;
in vec4 a34;
in vec4 a35;
in vec4 a36;
in vec4 a37;
in vec4 a38;
in vec4 a39;

void main(void)
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec + 0.0 * (a0 + a1 + a2 + a3 + a4 + a5 + a6 + a7 + a8 + a9 + a10 + a11 + a12 + a13 + a14 + a15 + a16 + a17 + a18 + a19 + a20 + a21 + a22 + a23 + a24 + a25 + a26 + a27 + a28 + a29 + a30 + a31 + a32 + a33 + a34 + a35 + a36 + a37 + a38 + a39);
  gl_Position = mc * pv;
}
