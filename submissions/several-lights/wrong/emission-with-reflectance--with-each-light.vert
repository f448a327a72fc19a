#version 410 core

const vec4 lglob = vec4(0.15, 0.12, 0.1, 1.0);
const vec4 lemi = vec4(0.02, 0.05, 0.09, 0.0);
const vec4 pl1 = vec4(2.0, 1.6, -2.5, 1.0);
const vec4 lamb1 = vec4(0.2, 0.18, 0.14, 0.0);
const vec4 ldiff1 = vec4(1.6, 1.4, 1.1, 0.0);
const vec4 lspec1 = vec4(1.5, 1.3, 1.2, 0.0);
const vec4 pl2 = vec4(-2.2, 0.9, -6.4, 1.0);
const vec4 lamb2 = vec4(0.05, 0.08, 0.11, 0.0);
const vec4 ldiff2 = vec4(0.7, 0.8, 1.9, 0.0);
const vec4 lspec2 = vec4(0.6, 0.9, 1.7, 0.0);
const float sc = 0.3;
const float sl = 0.13;
const float sq = 0.07;
const vec4 kamb = vec4(0.5, 0.11, 0.1, 1.0);
const vec4 kdiff = vec4(0.7, 0.16, 0.12, 1.0);
const vec4 kspec = vec4(0.4, 0.35, 0.3, 1.0);
const float kshi = 16.0;

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
  vec3 n = normalize((mg * cv).xyz);

  vec3 l1 = normalize((pl1 * p.w - p * pl1.w).xyz);
  vec3 l2 = normalize((pl2 * p.w - p * pl2.w).xyz);
  vec3 h1 = normalize(l1 + v);
  vec3 h2 = normalize(l2 + v);
  float r1 = length(pl1.xyz - p.xyz);
  float r2 = length(pl2.xyz - p.xyz);
  float d1 = 1.0 / (sc + sl * r1 + sq * r1 * r1);
  float d2 = 1.0 / (sc + sl * r2 + sq * r2 * r2);

  vec4 iamb1 = kamb * (lamb1 + lemi);
  vec4 idiff1 = max(dot(n, l1), 0.0) * kdiff * ldiff1;
  vec4 ispec1 = pow(max(dot(n, h1), 0.0), kshi) * kspec * lspec1;
  vec4 iamb2 = kamb * (lamb2 + lemi);
  vec4 idiff2 = max(dot(n, l2), 0.0) * kdiff * ldiff2;
  vec4 ispec2 = pow(max(dot(n, h2), 0.0), kshi) * kspec * lspec2;

  vc = kamb * lglob;
  vc += iamb1 + d1 * (idiff1 + ispec1);
  vc += iamb2 + d2 * (idiff2 + ispec2);

  gl_Position = mc * pv;
}
