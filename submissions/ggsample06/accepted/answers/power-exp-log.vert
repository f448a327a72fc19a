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
  vec4 P = mw * pv;
  vec3 V = normalize(-P.xyz);
  vec3 L = normalize(pl.xyz);
  vec3 N = normalize(mat3(mg) * vec3(cv));
  vec3 H = normalize(V + L);
  float nh = dot(N, H), sp = 0;
  if (nh > 0) sp = exp(kshi * log(nh));
  vc = kamb * lamb + max(dot(N, L), 0) * kdiff * ldiff + sp * kspec * lspec;
  gl_Position = mc * pv;
}
