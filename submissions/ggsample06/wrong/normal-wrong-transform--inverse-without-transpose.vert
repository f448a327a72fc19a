#version 410 core

layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

const vec4  pl    = vec4(0, 0, 1, 0);
const vec4  lamb  = vec4(vec3(0.2), 1);
const vec4  ldiff = vec4(1, 1, 1, 0);
const vec4  lspec = vec4(1, 1, 1, 0);
const vec4  kamb  = vec4(0.6, 0, 0, 1);
const vec4  kdiff = vec4(0.6, 0, 0, 1);
const vec4  kspec = vec4(vec3(0.4), 1);
const float kshi  = 80;

void main()
{
  mat3 nm = inverse(mat3(mw));   // normal matrix
  vec3 n = normalize(nm * cv.xyz);
  vec3 v = -normalize((mw * pv).xyz);
  vec3 h = normalize(pl.xyz + v);
  vc = kamb * lamb + max(dot(n, pl.xyz), 0) * kdiff * ldiff + pow(max(dot(n, h), 0), kshi) * kspec * lspec;
  gl_Position = mc * pv;
}
