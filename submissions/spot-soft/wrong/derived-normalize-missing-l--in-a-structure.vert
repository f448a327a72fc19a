#version 450 core
const vec4 pl = vec4(1.6, 1.4, -3.4, 1.0);
const vec4 lamb = vec4(0.25, 0.25, 0.3, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 0.95, 0.7, 0.0);
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.75, 0.12, 0.08, 1.0);
const vec4 kspec = vec4(0.4, 0.42, 0.45, 1.0);
const float kshi = 40.0;
const vec4 ldir = vec4(-0.9, -0.6, -1.0, 0.0);
const float sexp = 8.0;
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
    s.l = ((pl * p.w - p * pl.w).xyz);
    s.v = -normalize(p.xyz / p.w);
    return s;
}

void main()
{
    vec4 p = mw * pv;
    Point sp = at(p);
    float angle = acos(clamp(dot(-sp.l, normalize(ldir.xyz)), -1.0, 1.0));
    vec3 h = normalize(sp.l + sp.v);
    vec4 i_a = kamb * lamb;
    vec4 i_d = max(dot(sp.n, sp.l), 0.0) * kdiff * ldiff;
    vec4 i_s = pow(max(dot(sp.n, h), 0.0), kshi) * kspec * lspec;
    vc = (angle < 1.5707963 ? pow(cos(angle), sexp) : 0.0) * (i_a + i_d + i_s);
    gl_Position = mc * pv;
}
