#version 410 core
// ?: with vectors and matrices as its values, nested, and on the left of nothing.
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
    float d = dot(n, l), s = dot(n, normalize(l + v));
    vec4 diffuse = d > 0.0 ? d * kdiff * ldiff : vec4(0.0);
    vec4 specular = s <= 0.0 ? vec4(0.0) : s < 0.5 ? pow(s, kshi) * kspec * lspec : pow(s, kshi) * lspec * kspec;
    mat4 m = d < -2.0 ? mat4(1.0) : mc;
    vc = kamb * lamb + diffuse + specular;
    gl_Position = (d > 5.0 ? mw : m) * pv;
}
