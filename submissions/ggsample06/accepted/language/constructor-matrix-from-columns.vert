#version 410 core
// Matrices from column vectors and from scalars in column order.
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
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    mat3 g = mat3(mg[0].xyz, mg[1].xyz, vec3(mg[2]));
    mat3 w = mat3(mw[0][0], mw[0][1], mw[0][2], mw[1][0], mw[1][1], mw[1][2], mw[2].x, mw[2].y, mw[2].z);
    n = normalize(g * cv.xyz);
    vec3 eye = w * pv.xyz + mw[3].xyz;
    v = -normalize(eye);
    vc = kamb * lamb + max(dot(n, l), 0.) * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.), kshi) * kspec * lspec;
    gl_Position = mat4(mc[0], mc[1], vec4(mc[2].xyz, mc[2].w), mc[3]) * pv;
}
