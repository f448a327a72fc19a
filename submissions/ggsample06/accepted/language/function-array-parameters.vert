#version 410 core
// Arrays as parameters (by value), out parameters and results.
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
vec4 sum(vec4 a[3]) { vec4 s = a[0] + a[1] + a[2]; a[0] = vec4(50.0); return s; }
float[3] factors(float d, float s) { return float[3](1.0, d, s); }
void products(out vec4 result[3], const float f[3]) {
    result = vec4[](kamb * lamb, kdiff * ldiff, kspec * lspec);
    for (int i = 0; i < 3; i++) result[i] *= f[i];
}
void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    vec4 terms[3];
    products(terms, factors(max(dot(n, l), 0.0), pow(max(dot(n, normalize(l + v)), 0.0), kshi)));
    vc = 0.5 * sum(terms) + 0.5 * sum(terms);
    gl_Position = mc * pv;
}
