#version 410 core
// The same variable given twice: the copies do not see each other, and a global is not seen through a parameter.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
float shared_value;
float difference(inout float a, in float b) { a += 1.0; return a - b; }
float through(inout float x) { x = 5.0; float seen = shared_value; shared_value = 9.0; return seen; }
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float k = 2.0;
    float one = difference(k, k);               // 3 - 2
    shared_value = 1.0;
    float also_one = through(shared_value);     // the old value; then 5 is copied out over the 9
    float d = max(dot(n, l), 0.0) * one * also_one * (shared_value - 4.0) * (k - 2.0);
    vc = kamb * lamb + d * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
