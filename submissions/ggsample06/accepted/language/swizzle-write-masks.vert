#version 410 core
// Writing through swizzles: .xy =, .zx +=, .wzyx =, and a component at a time.
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
    vec4 c;
    c.wzyx = (kamb * lamb).wzyx;
    float d = max(dot(n, l), 0.0), s = pow(max(dot(n, normalize(l + v)), 0.0), kshi);
    c.zx += (d * kdiff * ldiff).zx;
    c.g += d * kdiff.g * ldiff.g;
    vec4 spec = s * kspec * lspec;
    c.rg += spec.rg;
    c.ba += spec.pq;
    vc.rgb = c.rgb;
    vc.a = 1.0;
    gl_Position.zw = (mc * pv).zw;
    gl_Position.yx = (mc * pv).yx;
}
