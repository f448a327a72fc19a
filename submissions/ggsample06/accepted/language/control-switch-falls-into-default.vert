#version 410 core
// switch that falls through two cases into default, and through default into another case.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
vec4 from(int first, float d, float s)
{
    vec4 c = vec4(0);
    switch (first) {
    case 0: c += kamb * lamb;
    case 1: c += d * kdiff * ldiff;
    default: c += s * kspec * lspec;
    }
    return c;
}
float steps(int first)
{
    float n = 0.0;
    switch (first) {
    case 0: n += 1.0;
    case 1: n += 10.0;
    default: n += 100.0;
    case 2: n += 1000.0; break;
    case 3: n += 10000.0;
    case 4: n += 100000.0;
    }
    return n;
}
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float d = max(dot(n, l), 0.0), s = pow(max(dot(n, normalize(l + v)), 0.0), kshi);
    vc = from(0, d, s) + from(1, d, s) - from(9, d, s) - from(1, d, 0.0);
    if (steps(0) != 1111.0 || steps(1) != 1110.0 || steps(2) != 1000.0 || steps(3) != 110000.0 || steps(9) != 1100.0) {
        vc = vec4(0);
    }
    gl_Position = mc * pv;
}
