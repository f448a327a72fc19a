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
    gl_Position = mc * pv;

    vec4 eyePos = mw * pv;
    vec3 view   = normalize(-eyePos.xyz);
    vec3 light  = normalize(pl.xyz);
    vec3 normal = normalize((mg * cv).xyz);
    vec3 halfVec = normalize(light + view);

    float diff = max(dot(normal, light), 0.0);
    float spec = pow(max(dot(normal, halfVec), 0.0), kshi);

    vc = (kamb * lamb) + (kdiff * ldiff * diff) + (kspec * lspec * spec);
}
