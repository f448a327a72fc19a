#version 410 core
// Variables called texture1, sampler, texture, sample_, image, texel.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
float texture = 1.0;
vec3 sampler = vec3(0.0);
float texture1(float image) { return max(image, 0.0); }
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float texel = texture1(dot(n, l)) * texture;
    sampler = normalize(l + v);
    vc = kamb * lamb + texel * kdiff * ldiff + pow(texture1(dot(n, sampler)), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
