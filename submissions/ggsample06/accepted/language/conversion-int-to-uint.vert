#version 410 core
// int becomes uint without a constructor: assignment, mixed operands, arguments; -1 wraps.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
uint half_of(uint x) { return x / 2u; }
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    uint count = 160;              // int literal into uint
    int two = 2;
    uint wrapped = 4294967295u + two;       // 1
    float exponent = half_of(count);
    uint big = -1;                           // 4294967295
    float unit = half_of(big) == 2147483647u ? 1.0 : 0.0;
    vc = (kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff) * unit * wrapped
       + pow(max(dot(n, normalize(l + v)), 0.0), exponent) * kspec * lspec;
    gl_Position = mc * pv;
}
