#version 410 core
// Twenty loops in each other, two turns each: a million turns.
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;
layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

void main(void)
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  float s = 0.0;
  for (int i0 = 0; i0 < int(2.0 * pv.w); i0++)
  for (int i1 = 0; i1 < int(2.0 * pv.w); i1++)
  for (int i2 = 0; i2 < int(2.0 * pv.w); i2++)
  for (int i3 = 0; i3 < int(2.0 * pv.w); i3++)
  for (int i4 = 0; i4 < int(2.0 * pv.w); i4++)
  for (int i5 = 0; i5 < int(2.0 * pv.w); i5++)
  for (int i6 = 0; i6 < int(2.0 * pv.w); i6++)
  for (int i7 = 0; i7 < int(2.0 * pv.w); i7++)
  for (int i8 = 0; i8 < int(2.0 * pv.w); i8++)
  for (int i9 = 0; i9 < int(2.0 * pv.w); i9++)
  for (int i10 = 0; i10 < int(2.0 * pv.w); i10++)
  for (int i11 = 0; i11 < int(2.0 * pv.w); i11++)
  for (int i12 = 0; i12 < int(2.0 * pv.w); i12++)
  for (int i13 = 0; i13 < int(2.0 * pv.w); i13++)
  for (int i14 = 0; i14 < int(2.0 * pv.w); i14++)
  for (int i15 = 0; i15 < int(2.0 * pv.w); i15++)
  for (int i16 = 0; i16 < int(2.0 * pv.w); i16++)
  for (int i17 = 0; i17 < int(2.0 * pv.w); i17++)
  for (int i18 = 0; i18 < int(2.0 * pv.w); i18++)
  for (int i19 = 0; i19 < int(2.0 * pv.w); i19++)
    s += 1.0;
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec + 0.0 * s;
  gl_Position = mc * pv;
}
