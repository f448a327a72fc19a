#version 410 core
// switch that falls through from one case into the next, several labels on one statement.
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
    case -1:
    case 0: c += kamb * lamb;
    case 1: c += d * kdiff * ldiff;
    case 2: c += s * kspec * lspec; break;
    case 3: c = vec4(1);
    }
    return c;
}
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float d = max(dot(n, l), 0.0), s = pow(max(dot(n, normalize(l + v)), 0.0), kshi);
    vc = 2.0 * from(0, d, s) - from(-1, d, s) + from(2, d, s) - from(2, 0.0, s) + from(99, d, s);
    gl_Position = mc * pv;
}
