#version 450 core
const vec4 pl = vec4(0.3, 0.9, -3.4, 1.0);
const vec4 lamb = vec4(0.25, 0.25, 0.3, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 0.95, 0.7, 0.0);
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.75, 0.12, 0.08, 1.0);
const vec4 kspec = vec4(0.4, 0.42, 0.45, 1.0);
const float kshi = 40.0;
const float fmax = 1.5;
const float fc = 0.6;
const float se = 2.5;
const float rc = 2.2;
layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

struct Point {
    vec3 n;
    vec3 l;
    vec3 v;
};

Point at(vec4 p)
{
    Point s;
    s.n = normalize((mg * cv).xyz);
    s.l = normalize((pl * p.w - p * pl.w).xyz);
    s.v = -normalize(p.xyz / p.w);
    return s;
}

void main()
{
    vec4 p = mw * pv;
    Point sp = at(p);
    float r = length(pl.xyz - p.xyz);
    float k0 = log(fc / fmax);
    float k1 = se / k0;
    float d = r <= rc ? fmax * exp(k0 * pow(r / rc, -k1)) : fc * pow(rc / r, se);
    vec3 h = (sp.l + sp.v) / 2.0;
    vec4 i_a = kamb * lamb;
    vec4 i_d = max(dot(sp.n, sp.l), 0.0) * kdiff * ldiff;
    vec4 i_s = pow(max(dot(sp.n, h), 0.0), kshi) * kspec * lspec;
    vc = i_a + min(d, 1.0) * (i_d + i_s);
    gl_Position = mc * pv;
}
