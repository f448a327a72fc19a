#version 410 core
// sinh, cosh, tanh, asinh, acosh, atanh.
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
    float d = max(dot(n, l), 0.0);
    float a = asinh(sinh(d)), b = atanh(tanh(d * 0.5)) * 2.0, c = acosh(cosh(d + 1.0)) - 1.0;
    float unit = cosh(2.0) * cosh(2.0) - sinh(2.0) * sinh(2.0);
    vc = unit * kamb * lamb + (a + b + c) / 3.0 * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
