#version 410 core
// #extension directives: all, known ones, and unknown ones with enable or warn.
#extension all : warn
#extension GL_ARB_explicit_attrib_location : enable
#extension GL_ARB_separate_shader_objects : enable
#extension GL_ARB_shading_language_420pack : enable
#extension GL_ARB_gpu_shader5 : require
#extension GL_EXT_not_a_real_extension : enable
#extension GL_NV_unknown : warn
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
#ifdef GL_ARB_gpu_shader5
const float unit = 1.0;
#else
const float unit = 0.0;
#endif
void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    vc = unit * kamb * lamb + max(dot(n, l), 0.) * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
