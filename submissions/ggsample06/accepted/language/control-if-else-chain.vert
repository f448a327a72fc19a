#version 410 core
// if, else if, else; dangling else; an empty branch.
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
    float facing = dot(n, l), d, s = dot(n, normalize(l + v));
    if (facing > 0.5) d = facing;
    else if (facing > 0.0) { d = facing; }
    else d = 0.0;
    if (s > 0.0) ; else s = 0.0;
    if (facing > -2.0)
        if (facing > 2.0) d = 7.0;
        else d = d + 0.0;               // belongs to the inner if
    vc = kamb * lamb + d * kdiff * ldiff + pow(s, kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
