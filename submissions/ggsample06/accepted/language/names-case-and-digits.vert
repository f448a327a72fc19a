#version 410 core
// Names that differ only by case or by a trailing digit or underscore.
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
float A(float x) { return max(x, 0.0); }
float a(float x) { return x * 2.0; }
void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float d = A(dot(n, l)), D = a(d), d1 = D / 2.0, d_1 = 7.0, d1_ = d1, D1 = 9.0;
    vec3 h = normalize(l + v), H = vec3(0.0), h_ = h, h_0 = H;
    float s = pow(A(dot(n, h_ + H + h_0)), kshi);
    vc = kamb * lamb + (d1_ + (d_1 + 2.0 - D1)) * kdiff * ldiff + s * kspec * lspec;
    gl_Position = mc * pv;
}
