#version 410 core
// Each loop turns once, and the driver compiles all of them.
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
  int turns = 0;
  int end = int(pv.w);
  for (int i0 = 0; i0 < end; i0++) for (int i1 = 0; i1 < end; i1++) for (int i2 = 0; i2 < end; i2++) for (int i3 = 0; i3 < end; i3++) for (int i4 = 0; i4 < end; i4++) for (int i5 = 0; i5 < end; i5++) for (int i6 = 0; i6 < end; i6++) for (int i7 = 0; i7 < end; i7++) for (int i8 = 0; i8 < end; i8++) for (int i9 = 0; i9 < end; i9++) for (int i10 = 0; i10 < end; i10++) for (int i11 = 0; i11 < end; i11++) for (int i12 = 0; i12 < end; i12++) for (int i13 = 0; i13 < end; i13++) for (int i14 = 0; i14 < end; i14++) for (int i15 = 0; i15 < end; i15++) for (int i16 = 0; i16 < end; i16++) for (int i17 = 0; i17 < end; i17++) for (int i18 = 0; i18 < end; i18++) for (int i19 = 0; i19 < end; i19++) for (int i20 = 0; i20 < end; i20++) for (int i21 = 0; i21 < end; i21++) for (int i22 = 0; i22 < end; i22++) for (int i23 = 0; i23 < end; i23++) for (int i24 = 0; i24 < end; i24++) for (int i25 = 0; i25 < end; i25++) for (int i26 = 0; i26 < end; i26++) for (int i27 = 0; i27 < end; i27++) for (int i28 = 0; i28 < end; i28++) for (int i29 = 0; i29 < end; i29++) for (int i30 = 0; i30 < end; i30++) for (int i31 = 0; i31 < end; i31++) for (int i32 = 0; i32 < end; i32++) for (int i33 = 0; i33 < end; i33++) for (int i34 = 0; i34 < end; i34++) for (int i35 = 0; i35 < end; i35++) for (int i36 = 0; i36 < end; i36++) for (int i37 = 0; i37 < end; i37++) for (int i38 = 0; i38 < end; i38++) for (int i39 = 0; i39 < end; i39++) for (int i40 = 0; i40 < end; i40++) for (int i41 = 0; i41 < end; i41++) for (int i42 = 0; i42 < end; i42++) for (int i43 = 0; i43 < end; i43++) for (int i44 = 0; i44 < end; i44++) for (int i45 = 0; i45 < end; i45++) for (int i46 = 0; i46 < end; i46++) for (int i47 = 0; i47 < end; i47++) for (int i48 = 0; i48 < end; i48++) for (int i49 = 0; i49 < end; i49++) for (int i50 = 0; i50 < end; i50++) for (int i51 = 0; i51 < end; i51++) for (int i52 = 0; i52 < end; i52++) for (int i53 = 0; i53 < end; i53++) for (int i54 = 0; i54 < end; i54++) for (int i55 = 0; i55 < end; i55++) for (int i56 = 0; i56 < end; i56++) for (int i57 = 0; i57 < end; i57++) for (int i58 = 0; i58 < end; i58++) for (int i59 = 0; i59 < end; i59++) for (int i60 = 0; i60 < end; i60++) for (int i61 = 0; i61 < end; i61++) for (int i62 = 0; i62 < end; i62++) for (int i63 = 0; i63 < end; i63++) for (int i64 = 0; i64 < end; i64++) for (int i65 = 0; i65 < end; i65++) for (int i66 = 0; i66 < end; i66++) for (int i67 = 0; i67 < end; i67++) for (int i68 = 0; i68 < end; i68++) for (int i69 = 0; i69 < end; i69++) for (int i70 = 0; i70 < end; i70++) for (int i71 = 0; i71 < end; i71++) for (int i72 = 0; i72 < end; i72++) for (int i73 = 0; i73 < end; i73++) for (int i74 = 0; i74 < end; i74++) for (int i75 = 0; i75 < end; i75++) for (int i76 = 0; i76 < end; i76++) for (int i77 = 0; i77 < end; i77++) for (int i78 = 0; i78 < end; i78++) for (int i79 = 0; i79 < end; i79++) turns++;
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec + 0.0 * float(turns);
  gl_Position = mc * pv;
}
