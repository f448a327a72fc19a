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

// corners of the triangle
const vec3 A = vec3(-1.0, -0.8660254, 0.0);
const vec3 B = vec3( 1.0, -0.8660254, 0.0);
const vec3 C = vec3( 0.0,  0.8660254, 0.0);

void main() {
    vec3 face = cross(B - A, C - A);
    vec3 n = normalize(mat3(mg) * face);
    vec3 v = normalize(-(mw * pv).xyz);
    vec3 l = normalize(pl.xyz);
    vec3 h = normalize(l + v);
    vc = kamb * lamb + kdiff * ldiff * max(dot(n, l), 0.0) + kspec * lspec * pow(max(dot(n, h), 0.0), kshi);
    gl_Position = mc * pv;
}
