#version 420 core
// 4.20: packHalf2x16, packSnorm2x16 and their inverses.
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
    vec2 halves = unpackHalf2x16(0x38003C00u);                         // 1, 0.5
    vec2 signs = unpackSnorm2x16(packSnorm2x16(vec2(-1.0, 1.0)));
    uint bits = packHalf2x16(vec2(1.0, 0.5));
    float unit = halves.x * halves.y * 2.0 * -signs.x * signs.y * float(bits == 0x38003C00u);
    float d = max(dot(n, l), 0.) * unit;
    vc = unit * kamb * lamb + d * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
