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

void main()
{
  vec4 p = mw * pv;
  vec3 n = normalize((mg * cv).xyz), v = normalize(-p.xyz);
  mat2x3 l = mat2x3(pl1.xyz - p.xyz, pl2.xyz - p.xyz);
  vec2 r = vec2(length(l[0]), length(l[1]));
  vec2 d = 1.0 / (sc + sl * r + sq * r * r);
  l[0] /= r.x;
  l[1] /= r.y;
  vec2 diffuse = max(n * l, 0.0);
  vec2 specular = pow(max(n * mat2x3(normalize(l[0] + v), normalize(l[1] + v)), 0.0), vec2(kshi));
  vc = kamb * (lglob + lamb1 + lamb2) + lemi
     + kdiff * (mat2x4(ldiff1, ldiff2) * (d * diffuse)) + kspec * (mat2x4(lspec1, lspec2) * (d * specular));
  gl_Position = mc * pv;
}
