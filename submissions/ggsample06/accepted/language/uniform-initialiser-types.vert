#version 410 core
// Initial values of uniforms of all types: int, uint, bool, mat3, an array, a constant expression.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
uniform int scale = 4;
uniform uint fifth = 5u;
uniform bool wanted = true;
uniform mat3 turn = mat3(0, 1, 0, 1, 0, 0, 0, 0, 1);
uniform float weights[2] = float[](0.25, 0.5 * 2.0);
uniform ivec2 pair = ivec2(3, -2);
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    n = turn * (turn * n);
    float d = wanted ? max(dot(n, l), 0.0) * float(scale) * weights[0] * weights[1] : 1.0;
    vc = kamb * lamb * float(pair.x + pair.y) + d * kdiff * ldiff
       + pow(max(dot(n, turn * normalize(l + v).yxz), 0.0), float(fifth << 4)) * kspec * lspec;
    gl_Position = mc * pv;
}
