#version 410 core
// Structs of structs.
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

struct S0 { float x; };
struct S1 { S0 s; };
struct S2 { S1 s; };
struct S3 { S2 s; };
struct S4 { S3 s; };
struct S5 { S4 s; };
struct S6 { S5 s; };
struct S7 { S6 s; };
struct S8 { S7 s; };
struct S9 { S8 s; };
struct S10 { S9 s; };
struct S11 { S10 s; };
struct S12 { S11 s; };
struct S13 { S12 s; };
struct S14 { S13 s; };
struct S15 { S14 s; };
struct S16 { S15 s; };
struct S17 { S16 s; };
struct S18 { S17 s; };
struct S19 { S18 s; };
struct S20 { S19 s; };
struct S21 { S20 s; };
struct S22 { S21 s; };
struct S23 { S22 s; };
struct S24 { S23 s; };
struct S25 { S24 s; };
struct S26 { S25 s; };
struct S27 { S26 s; };
struct S28 { S27 s; };
struct S29 { S28 s; };
struct S30 { S29 s; };
struct S31 { S30 s; };
struct S32 { S31 s; };
struct S33 { S32 s; };
struct S34 { S33 s; };
struct S35 { S34 s; };
struct S36 { S35 s; };
struct S37 { S36 s; };
struct S38 { S37 s; };
struct S39 { S38 s; };

void main(void)
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  S39 deep;
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;
  gl_Position = mc * pv;
}
