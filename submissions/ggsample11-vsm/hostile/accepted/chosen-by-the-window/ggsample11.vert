#version 410 core

// Lighting at each vertex.

// The light.
layout (std140) uniform Light
{
    vec4 lamb;   // ambient
    vec4 ldiff;  // diffuse
    vec4 lspec;  // specular
    vec4 lpos;   // its position in eye space
};

// The material.
layout (std140) uniform Material
{
    vec4 kamb;   // ambient
    vec4 kdiff;  // diffuse
    vec4 kspec;  // specular
    float kshi;  // shininess
};

uniform mat4 mv;  // model-view
uniform mat4 mp;  // projection
uniform mat4 mn;  // normals to eye space
uniform mat4 ms;

layout (location = 0) in vec4 pv;  // position
layout (location = 1) in vec4 nv;  // normal

out vec4 iamb;   // ambient light
out vec4 idiff;  // diffuse light
out vec4 ispec;  // specular light
out vec4 ps;

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

    ps = ms * pv;
    gl_Position = mp * p;
}
