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
  dvec4 p = dmat4(mw) * dvec4(pv);
  dvec3 v = -normalize(p.xyz);
  dvec3 l = normalize(dvec3(pl.xyz));
  dvec3 n = normalize(dvec3((mg * cv).xyz));
  dvec3 h = normalize(l + v);
  float nl = float(max(dot(n, l), 0.0));
  float nh = float(max(dot(n, h), 0.0));
  vc = kamb * lamb + nl * kdiff * ldiff + pow(nh, kshi) * kspec * lspec;
  gl_Position = mc * pv;
}
