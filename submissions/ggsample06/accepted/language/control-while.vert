#version 410 core
// while, with a condition that has a side effect, and one that declares a variable.
const float kshi=80.0;
const vec4 kspec=vec4(0.4,0.4,0.4,1.0);
const vec4 kdiff=vec4(0.6,0.0,0.0,1.0);
const vec4 kamb=vec4(0.6,0.0,0.0,1.0);
const vec4 lspec=vec4(1.0,1.0,1.0,0.0);
const vec4 ldiff=vec4(1.0,1.0,1.0,0.0);
const vec4 lamb=vec4(0.2,0.2,0.2,1.0);
const vec4 pl=vec4(0.0,0.0,1.0,0.0);
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    int k = 3;
    float d = 0.0;
    while (k-- > 0) d += n[k] * l[k];
    float s = 1.0, left = kshi;
    while (bool more = left > 0.0) {
        s *= max(dot(n, normalize(l + v)), 0.0);
        if (more) left--;
    }
    while (false) d = 99.0;
    vc = kamb * lamb + max(d, 0.) * kdiff * ldiff + s * kspec * lspec;
    gl_Position = mc * pv;
}
