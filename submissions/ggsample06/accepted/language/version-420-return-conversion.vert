#version 420 core
// 4.20: the value of return is converted to the type of the function.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
float zero() { return 0; }
float eighty() { uint e = 80u; return e; }
vec3 sun() { return ivec3(0, 0, 1); }
float sixtieth(int x) { return x; }
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    l = sun();
    vc = kamb * lamb + max(dot(n, l), zero()) * kdiff * ldiff * sixtieth(60) / 60.0
       + pow(max(dot(n, normalize(l + v)), zero()), eighty()) * kspec * lspec;
    gl_Position = mc * pv;
}
