#version 410 core
#extension GL_ARB_gpu_shader5 : enable
// precise on locals, parameters and gl_Position (GL_ARB_gpu_shader5 at 4.00).
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
precise gl_Position;
float shade(precise float x) { return max(x, 0.0); }
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    precise float d = shade(dot(n, l));
    precise vec3 h = normalize(l + v);
    vc = kamb * lamb + d * kdiff * ldiff + pow(shade(dot(n, h)), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
