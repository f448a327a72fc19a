#version 410 core

// Light
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);

// Material
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;

// Vertex attributes
in vec4 pv;
in vec4 cv;

// Matrices
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

// Output
out vec4 vc;

void main()
{
    vec3 p = vec3(mw * pv);
    vec3 eye = vec3(0.0);
    vec3 view = -normalize(eye - p);
    vec3 light = normalize(pl.xyz);
    vec3 normal = normalize(vec3(mg * cv));
    vec3 halfway = normalize(light + view);
    vc = kamb * lamb;
    vc += kdiff * ldiff * max(dot(normal, light), 0.0);
    vc += kspec * lspec * pow(max(dot(normal, halfway), 0.0), kshi);
    gl_Position = mc * pv;
}
