#version 420
// Packing to signed and half numbers, constants and run-time values.
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
  d *= float(packSnorm4x8(vec4(-1.0, 1.0, 0.0, 1.0)) == 0x7F007F81u && packSnorm2x16(vec2(-1.0, 1.0) * pv.w) == 0x7FFF8001u);
  vec2 h_ = unpackHalf2x16(0xC0003800u); d *= h_.x * 2.0 * h_.y / -2.0 * unpackHalf2x16(packHalf2x16(vec2(0.25, 1.0) * pv.w)).x * 4.0;
  d *= unpackHalf2x16(0x00010000u).y * 16777216.0 * unpackSnorm4x8(0x00810000u).z * -1.0;
  vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
  gl_Position = mc * pv;
}
