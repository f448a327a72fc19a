#version 410 core
// for without initialiser, condition or step; the counter declared outside; an empty body.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    int i = 0;
    float s = max(dot(n, normalize(l + v)), 0.0), e = 1.0;
    for (; i < 4; ) { e *= s; i++; }                     // s^4
    for (;;) { if (i >= 6) break; e *= e; ++i; }         // s^16
    float sixteenth = e;
    for (i = 0; i < 4; e *= sixteenth, ++i);             // s^80
    vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff * float(i - 3) + e * kspec * lspec;
    gl_Position = mc * pv;
}
