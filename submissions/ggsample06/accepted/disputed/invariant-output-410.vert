#version 410 core
// invariant on gl_Position (redeclared) and on vc.
const float kshi=80.0;
const vec4 kspec=vec4(0.4,0.4,0.4,1.0);
const vec4 kdiff=vec4(0.6,0.0,0.0,1.0);
const vec4 kamb=vec4(0.6,0.0,0.0,1.0);
const vec4 lspec=vec4(1.0,1.0,1.0,0.0);
const vec4 ldiff=vec4(1.0,1.0,1.0,0.0);
const vec4 lamb=vec4(0.2,0.2,0.2,1.0);
const vec4 pl=vec4(0.0,0.0,1.0,0.0);
layout(location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw, mc, mg;
invariant out vec4 vc;
invariant gl_Position;
void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    vc = kamb * lamb + max(dot(n, l), 0.) * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
