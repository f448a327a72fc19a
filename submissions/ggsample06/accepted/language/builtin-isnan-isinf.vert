#version 410 core
// isnan and isinf of ordinary and of infinite values.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
uniform float zero;
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float d = max(dot(n, l), 0.0), big = 1.0 / zero;
    if (isnan(d) || isinf(d) || any(isnan(n)) || any(isinf(l))) d = 1.0;
    if (!isinf(big) || isinf(big * 0.0 + 1.0) && false) d = 1.0;
    bvec2 which = isinf(vec2(1.0, -big));
    vc = kamb * lamb + d * kdiff * ldiff * float(which.y && !which.x)
       + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
