#version 410 core
// The bit functions on vectors, with values that are known only at run time.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
uniform int zero;
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    ivec2 a = ivec2(0x0FF0, 6) + zero;
    ivec2 low = findLSB(a), high = findMSB(a), ones = bitCount(a);                 // 4 1, 11 2, 8 2
    uvec2 part = bitfieldExtract(uvec2(a), 4 + zero, 4);                           // 15, 0
    ivec2 put = bitfieldInsert(a, ivec2(3), 0, 2);                                 // 0xFF3, 7
    uvec2 mirror = bitfieldReverse(uvec2(a)) >> 20;                                // 0x0FF, 0x600
    float unit = float(low.x - low.y + high.x - high.y + ones.x - ones.y + int(part.x) + put.y) / 40.0;      // 3+9+6+15+7
    unit *= float(mirror.x) / 255.0 * float(part.y + 1u) * float(put.x - 4082) * float(mirror.y) / 1536.0;
    vc = unit * (kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff) + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
