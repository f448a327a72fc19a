#version 330 core
const vec4 pl = vec4(2.0, 1.5, 1.0, 0.0);
const vec4 lamb = vec4(0.3, 0.3, 0.35, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 0.9, 0.0);
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.7, 0.15, 0.1, 1.0);
const vec4 kspec = vec4(0.4, 0.35, 0.3, 1.0);
const float kshi = 24.0;

flat in vec3 n;
in vec3 p;
out vec4 fc;
float lobe(vec3 a, vec3 b, float e) { return pow(max(dot(a, b), 0.0), e); }
void main()
{
  vec3 l = normalize(pl.xyz), N = normalize(n);
  fc = kamb * lamb + lobe(N, l, 1.0) * kdiff * ldiff + lobe(N, normalize(l + normalize(-p)), kshi) * kspec * lspec;
}
