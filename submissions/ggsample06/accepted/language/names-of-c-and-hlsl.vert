#version 410 core
// Names from C, C++ and HLSL that GLSL leaves free: main_, lerp, saturate, mul, register, auto, new, delete, NULL, printf.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
float saturate(float x) { return x < 0.0 ? 0.0 : x > 1.0 ? 1.0 : x; }
vec4 mul(mat4 m, vec4 x) { return m * x; }
float lerp(float a, float b, float t) { return a + (b - a) * t; }
float main_(float printf) { return max(printf, 0.0); }
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float auto = saturate(dot(n, l)), new = lerp(0.0, 2.0, 0.5), delete = 1.0, NULL = 0.0, register = 1.0;
    vc = kamb * lamb * new * delete + auto * kdiff * ldiff + NULL
       + pow(main_(dot(n, normalize(l + v))), kshi) * kspec * lspec * register;
    gl_Position = mul(mc, pv);
}
