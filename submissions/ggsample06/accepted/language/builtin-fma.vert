#version 410 core
// fma on scalars and vectors.
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
    float x = fma(n.x, l.x, fma(n.y, l.y, n.z * l.z)), s = pow(max(dot(n, normalize(l + v)), 0.), kshi);
    vec4 c = fma(vec4(max(x, 0.0)), kdiff * ldiff, kamb * lamb);
    vc = fma(kspec, lspec * s, c);
    gl_Position = fma(mc[0], pv.xxxx, fma(mc[1], pv.yyyy, fma(mc[2], pv.zzzz, mc[3] * pv.w)));
}
