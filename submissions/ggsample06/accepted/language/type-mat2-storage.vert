#version 410 core
// A mat2 as constant, local, function result and array element.
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
const mat2 swap = mat2(0.0, 1.0, 1.0, 0.0);
mat2 twice(mat2 m) { return m + m; }
void main(void) {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    mat2 halves[2];
    halves[0] = mat2(0.5);
    halves[1] = mat2(0.5, 0.0, 0.0, 0.25);
    vec2 ds = vec2(max(dot(n, l), 0.0), pow(max(dot(n, normalize(l + v)), 0.0), kshi));
    vec2 sd = swap * ds;                          // specular, diffuse
    sd = twice(halves[0]) * sd;                   // unchanged
    sd = halves[1] * sd * vec2(2.0, 4.0);         // unchanged
    vc = kamb * lamb + sd.y * kdiff * ldiff + sd.x * kspec * lspec;
    gl_Position = mc * pv;
}
