#version 410 core
// #line with a line, with a line and a source string, and by macro; __LINE__ and __FILE__ follow.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
#line 500
const int a = __LINE__;
#line 1000 7
const int b = __LINE__ , file = __FILE__;
#define WHERE 80
#line WHERE
const int c = __LINE__;
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float unit = float(a - 499) * float(b - 999) * float(file - 6);
    vc = unit * (kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff) + pow(max(dot(n, normalize(l + v)), 0.0), float(c)) * kspec * lspec;
    gl_Position = mc * pv;
}
