#version 410 core
// The product of matrices is the linear one, not component by component; order matters.
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
    mat4 projection = mc * inverse(mw);
    vec4 clip = projection * mw * pv;             // (projection * mw) * pv
    vec4 other = projection * (mw * pv);
    n = normalize((mat4(1.0) * mg * cv).xyz);
    vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff
       + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
    gl_Position = 0.5 * clip + 0.5 * other;
}
