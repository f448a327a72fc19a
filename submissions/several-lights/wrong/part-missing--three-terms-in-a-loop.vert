#version 400 core
const vec4 lglob = vec4(0.15, 0.12, 0.1, 1.0);
const vec4 lemi = vec4(0.02, 0.05, 0.09, 0.0);
const vec4 pl1 = vec4(2.0, 1.6, -2.5, 1.0);
const vec4 lamb1 = vec4(0.2, 0.18, 0.14, 0.0);
const vec4 ldiff1 = vec4(1.6, 1.4, 1.1, 0.0);
const vec4 lspec1 = vec4(1.5, 1.3, 1.2, 0.0);
const vec4 pl2 = vec4(-2.2, 0.9, -6.4, 1.0);
const vec4 lamb2 = vec4(0.05, 0.08, 0.11, 0.0);
const vec4 ldiff2 = vec4(0.7, 0.8, 1.9, 0.0);
const vec4 lspec2 = vec4(0.6, 0.9, 1.7, 0.0);
const float sc = 0.3;
const float sl = 0.13;
const float sq = 0.07;
const vec4 kamb = vec4(0.5, 0.11, 0.1, 1.0);
const vec4 kdiff = vec4(0.7, 0.16, 0.12, 1.0);
const vec4 kspec = vec4(0.4, 0.35, 0.3, 1.0);
const float kshi = 16.0;
layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;


struct Lamp { vec4 at, a, d, s; };
Lamp lamps[2] = Lamp[2](Lamp(pl1, lamb1, ldiff1, lspec1), Lamp(pl2, lamb2, ldiff2, lspec2));

void main()
{
    vec4 p = mw * pv;
    vec3 pos = p.xyz / p.w;
    vec3 v = normalize(-pos);
    vec3 n = normalize((mg * cv).xyz);
    vec4 result = vec4(0.0);
    for (int i = 0; i < 2; ++i)
    {
        vec3 way = lamps[i].at.xyz - pos;
        float r = length(way);
        vec3 l = way / r;
        vec3 h = normalize(l + v);
        float d = 1.0 / (sc + r * (sl + r * sq));
        vec4 here = max(dot(n, l), 0.0) * kdiff * lamps[i].d;
        here += pow(max(dot(n, h), 0.0), kshi) * kspec * lamps[i].s;
        here *= d;
        result += here;
    }
    vc = result;
    gl_Position = mc * pv;
}
