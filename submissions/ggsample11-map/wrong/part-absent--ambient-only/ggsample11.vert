#version 410 core

layout (std140) uniform Light
{
    vec4 lamb;
    vec4 ldiff;
    vec4 lspec;
    vec4 lpos;
};

layout (std140) uniform Material
{
    vec4 kamb;
    vec4 kdiff;
    vec4 kspec;
    float kshi;
};

uniform mat4 mv;
uniform mat4 mp;
uniform mat4 mn;

layout (location = 0) in vec4 pv;
layout (location = 1) in vec4 nv;

out vec4 iamb;
out vec4 idiff;
out vec4 ispec;

void main()
{
    vec4 p = mv * pv;
    vec3 v = normalize(p.xyz);
    vec3 l = normalize((lpos * p.w - p * lpos.w).xyz);
    vec3 n = normalize((mn * nv).xyz);
    vec3 h = normalize(l - v);

    iamb = kamb * lamb;
    idiff = max(dot(n, l), 0.0) * kdiff * ldiff;
    ispec = pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;

    gl_Position = mp * p;
}
