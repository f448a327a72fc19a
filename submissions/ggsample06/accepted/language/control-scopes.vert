#version 410 core
// A name in an inner scope hides the outer one until the scope ends; loop variables too.
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
float d = 100.0;
void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float d = max(dot(n, l), 0.0);
    { float d = 50.0; { int d = 3; d++; } d += 1.0; }
    for (int d = 0; d < 3; d++) { float n = 9.0; n += float(d); }
    if (d > -1.0) { vec3 l = vec3(5.0); l.x = d; }
    float k = d, s = k;      // the initialiser of s sees k
    s = pow(max(dot(n, normalize(l + v)), 0.0), kshi);
    vc = kamb * lamb + k * kdiff * ldiff + s * kspec * lspec;
    gl_Position = mc * pv;
}
