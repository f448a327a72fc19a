#version 410 core
// mix with a boolean chooses, component by component.
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
    vec2 x = vec2(dot(n, l), dot(n, normalize(l + v)));
    vec2 y = mix(vec2(0.0), x, greaterThan(x, vec2(0.0)));
    float unit = mix(5.0, 1.0, true);
    vc = unit * kamb * lamb + mix(y.x, 7.0, false) * kdiff * ldiff + pow(y.y, kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
