#version 410 core
// Two hundred functions in a row.
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

float f0(float x) { return x; }
float f1(float x) { return f0(x); }
float f2(float x) { return f1(x); }
float f3(float x) { return f2(x); }
float f4(float x) { return f3(x); }
float f5(float x) { return f4(x); }
float f6(float x) { return f5(x); }
float f7(float x) { return f6(x); }
float f8(float x) { return f7(x); }
float f9(float x) { return f8(x); }
float f10(float x) { return f9(x); }
float f11(float x) { return f10(x); }
float f12(float x) { return f11(x); }
float f13(float x) { return f12(x); }
float f14(float x) { return f13(x); }
float f15(float x) { return f14(x); }
float f16(float x) { return f15(x); }
float f17(float x) { return f16(x); }
float f18(float x) { return f17(x); }
float f19(float x) { return f18(x); }
float f20(float x) { return f19(x); }
float f21(float x) { return f20(x); }
float f22(float x) { return f21(x); }
float f23(float x) { return f22(x); }
float f24(float x) { return f23(x); }
float f25(float x) { return f24(x); }
float f26(float x) { return f25(x); }
float f27(float x) { return f26(x); }
float f28(float x) { return f27(x); }
float f29(float x) { return f28(x); }
float f30(float x) { return f29(x); }
float f31(float x) { return f30(x); }
float f32(float x) { return f31(x); }
float f33(float x) { return f32(x); }
float f34(float x) { return f33(x); }
float f35(float x) { return f34(x); }
float f36(float x) { return f35(x); }
float f37(float x) { return f36(x); }
float f38(float x) { return f37(x); }
float f39(float x) { return f38(x); }
float f40(float x) { return f39(x); }
float f41(float x) { return f40(x); }
float f42(float x) { return f41(x); }
float f43(float x) { return f42(x); }
float f44(float x) { return f43(x); }
float f45(float x) { return f44(x); }
float f46(float x) { return f45(x); }
float f47(float x) { return f46(x); }
float f48(float x) { return f47(x); }
float f49(float x) { return f48(x); }
float f50(float x) { return f49(x); }
float f51(float x) { return f50(x); }
float f52(float x) { return f51(x); }
float f53(float x) { return f52(x); }
float f54(float x) { return f53(x); }
float f55(float x) { return f54(x); }
float f56(float x) { return f55(x); }
float f57(float x) { return f56(x); }
float f58(float x) { return f57(x); }
float f59(float x) { return f58(x); }
float f60(float x) { return f59(x); }
float f61(float x) { return f60(x); }
float f62(float x) { return f61(x); }
float f63(float x) { return f62(x); }
float f64(float x) { return f63(x); }
float f65(float x) { return f64(x); }
float f66(float x) { return f65(x); }
float f67(float x) { return f66(x); }
float f68(float x) { return f67(x); }
float f69(float x) { return f68(x); }
float f70(float x) { return f69(x); }
float f71(float x) { return f70(x); }
float f72(float x) { return f71(x); }
float f73(float x) { return f72(x); }
float f74(float x) { return f73(x); }
float f75(float x) { return f74(x); }
float f76(float x) { return f75(x); }
float f77(float x) { return f76(x); }
float f78(float x) { return f77(x); }
float f79(float x) { return f78(x); }
float f80(float x) { return f79(x); }
float f81(float x) { return f80(x); }
float f82(float x) { return f81(x); }
float f83(float x) { return f82(x); }
float f84(float x) { return f83(x); }
float f85(float x) { return f84(x); }
float f86(float x) { return f85(x); }
float f87(float x) { return f86(x); }
float f88(float x) { return f87(x); }
float f89(float x) { return f88(x); }
float f90(float x) { return f89(x); }
float f91(float x) { return f90(x); }
float f92(float x) { return f91(x); }
float f93(float x) { return f92(x); }
float f94(float x) { return f93(x); }
float f95(float x) { return f94(x); }
float f96(float x) { return f95(x); }
float f97(float x) { return f96(x); }
float f98(float x) { return f97(x); }
float f99(float x) { return f98(x); }
float f100(float x) { return f99(x); }
float f101(float x) { return f100(x); }
float f102(float x) { return f101(x); }
float f103(float x) { return f102(x); }
float f104(float x) { return f103(x); }
float f105(float x) { return f104(x); }
float f106(float x) { return f105(x); }
float f107(float x) { return f106(x); }
float f108(float x) { return f107(x); }
float f109(float x) { return f108(x); }
float f110(float x) { return f109(x); }
float f111(float x) { return f110(x); }
float f112(float x) { return f111(x); }
float f113(float x) { return f112(x); }
float f114(float x) { return f113(x); }
float f115(float x) { return f114(x); }
float f116(float x) { return f115(x); }
float f117(float x) { return f116(x); }
float f118(float x) { return f117(x); }
float f119(float x) { return f118(x); }
float f120(float x) { return f119(x); }
float f121(float x) { return f120(x); }
float f122(float x) { return f121(x); }
float f123(float x) { return f122(x); }
float f124(float x) { return f123(x); }
float f125(float x) { return f124(x); }
float f126(float x) { return f125(x); }
float f127(float x) { return f126(x); }
float f128(float x) { return f127(x); }
float f129(float x) { return f128(x); }
float f130(float x) { return f129(x); }
float f131(float x) { return f130(x); }
float f132(float x) { return f131(x); }
float f133(float x) { return f132(x); }
float f134(float x) { return f133(x); }
float f135(float x) { return f134(x); }
float f136(float x) { return f135(x); }
float f137(float x) { return f136(x); }
float f138(float x) { return f137(x); }
float f139(float x) { return f138(x); }
float f140(float x) { return f139(x); }
float f141(float x) { return f140(x); }
float f142(float x) { return f141(x); }
float f143(float x) { return f142(x); }
float f144(float x) { return f143(x); }
float f145(float x) { return f144(x); }
float f146(float x) { return f145(x); }
float f147(float x) { return f146(x); }
float f148(float x) { return f147(x); }
float f149(float x) { return f148(x); }
float f150(float x) { return f149(x); }
float f151(float x) { return f150(x); }
float f152(float x) { return f151(x); }
float f153(float x) { return f152(x); }
float f154(float x) { return f153(x); }
float f155(float x) { return f154(x); }
float f156(float x) { return f155(x); }
float f157(float x) { return f156(x); }
float f158(float x) { return f157(x); }
float f159(float x) { return f158(x); }
float f160(float x) { return f159(x); }
float f161(float x) { return f160(x); }
float f162(float x) { return f161(x); }
float f163(float x) { return f162(x); }
float f164(float x) { return f163(x); }
float f165(float x) { return f164(x); }
float f166(float x) { return f165(x); }
float f167(float x) { return f166(x); }
float f168(float x) { return f167(x); }
float f169(float x) { return f168(x); }
float f170(float x) { return f169(x); }
float f171(float x) { return f170(x); }
float f172(float x) { return f171(x); }
float f173(float x) { return f172(x); }
float f174(float x) { return f173(x); }
float f175(float x) { return f174(x); }
float f176(float x) { return f175(x); }
float f177(float x) { return f176(x); }
float f178(float x) { return f177(x); }
float f179(float x) { return f178(x); }
float f180(float x) { return f179(x); }
float f181(float x) { return f180(x); }
float f182(float x) { return f181(x); }
float f183(float x) { return f182(x); }
float f184(float x) { return f183(x); }
float f185(float x) { return f184(x); }
float f186(float x) { return f185(x); }
float f187(float x) { return f186(x); }
float f188(float x) { return f187(x); }
float f189(float x) { return f188(x); }
float f190(float x) { return f189(x); }
float f191(float x) { return f190(x); }
float f192(float x) { return f191(x); }
float f193(float x) { return f192(x); }
float f194(float x) { return f193(x); }
float f195(float x) { return f194(x); }
float f196(float x) { return f195(x); }
float f197(float x) { return f196(x); }
float f198(float x) { return f197(x); }
float f199(float x) { return f198(x); }
float f200(float x) { return f199(x); }

void main(void)
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec * f200(1.0);
  gl_Position = mc * pv;
}
