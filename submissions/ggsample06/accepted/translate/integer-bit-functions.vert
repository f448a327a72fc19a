#version 410 core
// bitfieldExtract, bitfieldInsert, bitfieldReverse, bitCount, findLSB and findMSB of int and uint.
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
  int i = int(pv.w) * -20; uint u = uint(pv.w) * 0xF0u; int three = int(pv.w) * 3;
  bool ok = bitfieldExtract(u, 4, 4) == 15u && bitfieldExtract(i, 2, three) == 3 && bitfieldExtract(i, 0, 5) == 12;
  ok = ok && bitfieldInsert(0u, u, 0, 8) == 240u && bitfieldInsert(i, 0, 2, 3) == -32 && bitfieldReverse(u) == 0x0F000000u;
  ok = ok && bitCount(u) == 4 && bitCount(-1) == 32 && findLSB(u) == 4 && findMSB(u) == 7 && findMSB(i) == 4 && findMSB(-1) == -1;
  ok = ok && findLSB(ivec2(i, 0)) == ivec2(2, -1) && bitCount(uvec3(u, 1u, 0u)) == ivec3(4, 1, 0) && findMSB(0u) == -1;
  d *= float(ok);
  vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
  gl_Position = mc * pv;
}
