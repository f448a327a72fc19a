#version 410 core
// Floating-point literals in all their spellings: .5, 1., 1e-3, 1E+1, 2e0f, 3.F.
const vec4 pl = vec4(0., 0e0, 1e0, .0);
const vec4 lamb = vec4(.2, 2e-1, 20E-2f, 1.F);
const vec4 ldiff = vec4(1., 1.0f, 10.e-1, 0.);
const vec4 lspec = vec4(.1e1, .1E+1, 1.F, 0.f);
const vec4 kamb = vec4(60.e-2, 0.0, 0.f, 1.);
const vec4 kdiff = vec4(.06E1f, 0., .0, 1.);
const vec4 kspec = vec4(4e-1, 0.04e+1, 4000.e-4, 1.);
const float kshi = 8.e1;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float d = max(dot(n, l), 0e5), s = pow(max(dot(n, normalize(l + v)), .0f), kshi);
    vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
    gl_Position = mc * pv;
}
