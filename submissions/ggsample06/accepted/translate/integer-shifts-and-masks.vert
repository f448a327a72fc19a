#version 410 core
// Shifts of signed and unsigned numbers, with counts of the other sign.
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;
in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

void main()
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  float d = max(dot(n, l), 0.0);
  float s = pow(max(dot(n, h), 0.0), kshi);
  int a = int(pv.w) * -8; uint u = uint(pv.w) * 0x80000000u;
  d *= float(a >> 1 == -4 && u >> 31 == 1u && (a << 2u) == -32 && (u >> 4) == 0x08000000u && (~a) == 7 && (a ^ 3) == -5 && (a | 1) == -7 && (ivec2(a) >> ivec2(1, 2)) == ivec2(-4, -2));
  a <<= 1; a >>= 2; a &= 7; a |= 16; a ^= 4; d *= float(a) / 16.0;
  vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
  gl_Position = mc * pv;
}
