#version 410 core
// An overload of a built-in name that the built-in function does not have: pow(float, int).
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
float pow(float x, int e)
{
    float r = 1.0;
    for (int i = 0; i < e; i++) r *= x;
    return r;
}
float dot(vec3 a, vec3 b, float lowest) { return max(a.x * b.x + a.y * b.y + a.z * b.z, lowest); }
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float d = dot(n, l, 0.0), s = pow(dot(n, normalize(l + v), 0.0), 80);
    vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
    gl_Position = mc * pv;
}
