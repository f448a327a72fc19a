#version 410 core
// A macro that defines functions, and one that stands for a list of arguments.
#define DEFINE(name, type, body) type name(type x) { return body; }
#define LIST n, l
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
DEFINE(positive, float, max(x, 0.0))
DEFINE(unit, vec3, normalize(x))
DEFINE(same, vec4, x)
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    vc = same(kamb * lamb) + positive(dot(LIST)) * kdiff * ldiff + pow(positive(dot(n, unit(l + v))), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
