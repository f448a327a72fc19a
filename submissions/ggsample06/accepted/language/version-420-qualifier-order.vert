#version 420 core
// 4.20: qualifiers in any order: layout after in, centroid after out, in before const.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in layout(location = 0) vec4 pv;
in vec4 cv;
uniform mat4 mw, mc, mg;
out centroid vec4 vc;
float positive(in const float x) { return max(x, 0.0); }
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    vc = kamb * lamb + positive(dot(n, l)) * kdiff * ldiff + pow(positive(dot(n, normalize(l + v))), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
