#version 410 core
// A subroutine uniform with one function to choose from.
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
subroutine float Shade(vec3 a, vec3 b);
subroutine(Shade) float lambert(vec3 a, vec3 b) { return max(dot(a, b), 0.0); }
subroutine uniform Shade shade;
void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    vc = kamb * lamb + shade(n, l) * kdiff * ldiff + pow(shade(n, normalize(l + v)), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
