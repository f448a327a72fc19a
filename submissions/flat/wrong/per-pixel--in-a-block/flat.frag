#version 410 core
const vec4 pl = vec4(2.0, 1.5, 1.0, 0.0);
const vec4 lamb = vec4(0.3, 0.3, 0.35, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 0.9, 0.0);
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.7, 0.15, 0.1, 1.0);
const vec4 kspec = vec4(0.4, 0.35, 0.3, 1.0);
const float kshi = 24.0;

in Varying { vec3 n; vec4 p; } o;
out vec4 fc;
void main()
{
  vec3 n = normalize(o.n), v = -normalize(o.p.xyz), l = normalize(pl.xyz);
  fc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
}
