#version 410 core
// inverse of mat2, mat3 and mat4; the eye-space position back from clip space.
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
    vec4 clip = mc * pv;
    vec4 object = inverse(mc) * clip;
    vec4 p = mw * (object / object.w);
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz);
    vec3 n = normalize(inverse(mat3(inverse(mg))) * cv.xyz);
    mat2 m = inverse(mat2(4.0, 2.0, 7.0, 6.0)) * 10.0;             // 6 -2 / -7 4
    float unit = m[0][0] + m[0][1] + m[1][0] + m[1][1];            // 1
    vc = unit * kamb * lamb + max(dot(n, l), 0.) * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.), kshi) * kspec * lspec;
    gl_Position = clip;
}
