#version 410 core
// Packing of values that are known only at run time; the lost precision stays below 1/65535.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float d = max(dot(n, l), 0.0), s = pow(max(dot(n, normalize(l + v)), 0.0), kshi);
    vec2 ds = unpackUnorm2x16(packUnorm2x16(vec2(d, s)));
    vc = kamb * lamb + ds.x * kdiff * ldiff + ds.y * kspec * lspec;
    gl_Position = mc * pv;
}
