#version 330 core
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

in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

// 1 つの光源からの光
vec3 lit(vec3 P, vec3 N, vec4 pl, vec4 lamb, vec4 ldiff, vec4 lspec)
{
  vec3 toLight = pl.xyz / pl.w - P;
  float r = length(toLight);
  float d = 1.0 / (sc + r * (sl + sq * r));
  vec3 L = toLight / r;
  vec3 H = normalize(L - normalize(P));
  float diffuse = max(dot(N, L), 0);
  float specular = pow(max(dot(N, H), 0), kshi);
  return kamb.rgb * lamb.rgb + d * (diffuse * kdiff.rgb * ldiff.rgb + specular * kspec.rgb * lspec.rgb);
}

void main()
{
  vec4 eye = mw * pv;
  vec3 P = eye.xyz / eye.w;
  vec3 N = normalize(mat3(mg) * cv.xyz);
  vec3 color = kamb.rgb * lglob.rgb + lemi.rgb;
  color += lit(P, N, pl1, lamb1, ldiff1, lspec1);
  color = lit(P, N, pl2, lamb2, ldiff2, lspec2);
  vc = vec4(color, 1.0);
  gl_Position = mc * pv;
}
