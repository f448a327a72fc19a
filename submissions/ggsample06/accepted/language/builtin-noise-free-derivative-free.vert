#version 410 core
// Names of functions that exist only in fragment shaders, used for the student's own: dFdx, fwidth, discard_.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
float dFdx(float x) { return max(x, 0.0); }
float fwidth(vec3 a, vec3 b) { return dot(a, b); }
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    vc = kamb * lamb + dFdx(fwidth(n, l)) * kdiff * ldiff + pow(dFdx(fwidth(n, normalize(l + v))), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
