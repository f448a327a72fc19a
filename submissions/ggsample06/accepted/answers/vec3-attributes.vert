#version 410 core
layout(location = 0) in vec3 pv;
layout(location = 1) in vec3 cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;
void main()
{
    vec4 p = mw * vec4(pv, 1.0);
    vec3 v = -normalize(p.xyz);
    vec3 l = normalize(pl.xyz);
    vec3 n = normalize(mat3(mg) * cv);
    vec3 h = normalize(l + v);
    vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;
    gl_Position = mc * vec4(pv, 1.0);
}
