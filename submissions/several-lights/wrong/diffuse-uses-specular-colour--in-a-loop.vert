#version 410
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

void main() {
    const int n = 2;
    vec4 place[n] = vec4[n](pl1, pl2);
    vec4 amb[n] = vec4[n](lamb1, lamb2);
    vec4 diff[n] = vec4[n](ldiff1, ldiff2);
    vec4 spec[n] = vec4[n](lspec1, lspec2);
    vec4 p = mw * pv;
    vec3 view = normalize(-p.xyz);
    vec3 normal = normalize((mg * cv).xyz);
    vec4 sum = kamb * lglob + lemi;
    for (int i = 0; i < n; i++) {
        vec3 light = normalize(place[i].xyz - p.xyz);
        float r = distance(place[i].xyz, p.xyz);
        float fade = 1.0 / (sc + sl * r + sq * pow(r, 2.0));
        vec3 halfway = normalize(light + view);
        sum += kamb * amb[i];
        sum += fade * kspec * diff[i] * max(dot(normal, light), 0.0);
        sum += fade * kspec * spec[i] * pow(max(dot(normal, halfway), 0.0), kshi);
    }
    vc = sum;
    gl_Position = mc * pv;
}
