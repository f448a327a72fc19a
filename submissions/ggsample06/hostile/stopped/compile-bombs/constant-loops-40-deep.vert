#version 410 core
// Loops that the driver unrolls, in each other.
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
  for (int i0 = 0; i0 < 2; i0++) for (int i1 = 0; i1 < 2; i1++) for (int i2 = 0; i2 < 2; i2++) for (int i3 = 0; i3 < 2; i3++) for (int i4 = 0; i4 < 2; i4++) for (int i5 = 0; i5 < 2; i5++) for (int i6 = 0; i6 < 2; i6++) for (int i7 = 0; i7 < 2; i7++) for (int i8 = 0; i8 < 2; i8++) for (int i9 = 0; i9 < 2; i9++) for (int i10 = 0; i10 < 2; i10++) for (int i11 = 0; i11 < 2; i11++) for (int i12 = 0; i12 < 2; i12++) for (int i13 = 0; i13 < 2; i13++) for (int i14 = 0; i14 < 2; i14++) for (int i15 = 0; i15 < 2; i15++) for (int i16 = 0; i16 < 2; i16++) for (int i17 = 0; i17 < 2; i17++) for (int i18 = 0; i18 < 2; i18++) for (int i19 = 0; i19 < 2; i19++) for (int i20 = 0; i20 < 2; i20++) for (int i21 = 0; i21 < 2; i21++) for (int i22 = 0; i22 < 2; i22++) for (int i23 = 0; i23 < 2; i23++) for (int i24 = 0; i24 < 2; i24++) for (int i25 = 0; i25 < 2; i25++) for (int i26 = 0; i26 < 2; i26++) for (int i27 = 0; i27 < 2; i27++) for (int i28 = 0; i28 < 2; i28++) for (int i29 = 0; i29 < 2; i29++) for (int i30 = 0; i30 < 2; i30++) for (int i31 = 0; i31 < 2; i31++) for (int i32 = 0; i32 < 2; i32++) for (int i33 = 0; i33 < 2; i33++) for (int i34 = 0; i34 < 2; i34++) for (int i35 = 0; i35 < 2; i35++) for (int i36 = 0; i36 < 2; i36++) for (int i37 = 0; i37 < 2; i37++) for (int i38 = 0; i38 < 2; i38++) for (int i39 = 0; i39 < 2; i39++) s += n.x * 0.001;
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec + 0.0 * s;
  gl_Position = mc * pv;
}
