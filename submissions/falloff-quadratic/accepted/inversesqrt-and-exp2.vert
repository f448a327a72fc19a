#version 410 core
const vec4 pl = vec4(0.3, 0.9, -3.4, 1.0);
const vec4 lamb = vec4(0.25, 0.25, 0.3, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 0.95, 0.7, 0.0);
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.75, 0.12, 0.08, 1.0);
const vec4 kspec = vec4(0.4, 0.42, 0.45, 1.0);
const float kshi = 40.0;
const float sc = 0.2;
const float sl = 0.15;
const float sq = 0.1;
layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

void main()
{
    vec4 p = mw * pv;
    vec3 q = pl.xyz - p.xyz;
    float s = inversesqrt(dot(q, q));
    vec3 l = q * s;
    float r = 1.0 / s;
    vec3 v = -p.xyz * inversesqrt(dot(p.xyz, p.xyz));
    vec3 n = normalize(vec3(mg * vec4(cv.xyz, 0.0)));
    vec3 b = l + v;
    float nh = dot(n, b) / length(b);
    float shine = nh > 0.0 ? exp2(kshi * log2(nh)) : 0.0;
    float d = s * s / (sc * s * s + sl * s + sq);
    vc = fma(vec4(d), max(dot(n, l), 0.0) * kdiff * ldiff + shine * kspec * lspec, kamb * lamb);
    gl_Position = mc * pv;
}
