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
    vec4 p = pv.x * mw[0] + pv.y * mw[1] + pv.z * mw[2] + mw[3];
    vec3 n = normalize(cv.x * mg[0].xyz + cv.y * mg[1].xyz + cv.z * mg[2].xyz);
    vec3 v = -p.xyz / length(p.xyz);
    vec3 l = pl.xyz;
    vec3 h = normalize(l + v);
    vc = kamb * lamb + kdiff * ldiff * max(dot(n, l), 0.0) + kspec * lspec * pow(max(dot(n, h), 0.0), kshi);
    gl_Position = mc[0] * pv.x + mc[1] * pv.y + mc[2] * pv.z + mc[3] * pv.w;
}
