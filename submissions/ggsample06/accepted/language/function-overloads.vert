#version 410 core
// Overloads told apart by the number and the types of their parameters.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
float part(float x) { return max(x, 0.0); }
float part(float x, float e) { return pow(part(x), e); }
float part(vec3 a, vec3 b) { return part(dot(a, b)); }
float part(vec3 a, vec3 b, float e) { return part(dot(a, b), e); }
float part(int x) { return float(x) * 0.5; }
float part(bool x) { return x ? 0.25 : 0.0; }
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float unit = part(2) * part(true) * part(8) * part(1.0);           // 1 * .25 * 4 * 1
    vc = unit * kamb * lamb + part(n, l) * kdiff * ldiff + part(n, normalize(l + v), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
