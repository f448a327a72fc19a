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

void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w);
    vec3 l = normalize((pl * p.w - p * pl.w).xyz);
    vec3 n = normalize((mg * cv).xyz);
    vec3 h = normalize(l + v);

    vec4 iamb = kamb * lamb;
    vec4 idiff = max(dot(n, l), 0.0) * kdiff * ldiff;
    vec4 ispec = pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;
    vc = iamb + idiff + ispec;

    vc = cv;

    gl_Position = mc * pv;
}
