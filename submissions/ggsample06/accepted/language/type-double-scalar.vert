#version 410 core
// The whole equation in double, narrowed at the end.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main()
{
    dvec4 p = dmat4(mw) * dvec4(pv);
    dvec3 v = -normalize(p.xyz / p.w);
    dvec3 l = normalize((dvec4(pl) * p.w - p * double(pl.w)).xyz);
    dvec3 n = normalize((dmat4(mg) * dvec4(cv)).xyz);
    double d = max(dot(n, l), 0.0lf);
    double s = max(dot(n, normalize(l + v)), 0.0lf);
    vc = kamb * lamb + float(d) * kdiff * ldiff + pow(float(s), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
