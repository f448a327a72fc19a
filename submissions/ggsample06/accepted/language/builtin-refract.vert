#version 410 core
// refract: straight on for equal indices, zero beyond total reflection, bent in between.
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
    vec3 on = -refract(-l, n, 1.0);                                            // l where N.L > 0
    float d = dot(n, l) > 0.0 ? max(dot(n, on), 0.0) : 0.0;
    vec2 none = refract(normalize(vec2(1.0, -0.1)), vec2(0.0, 1.0), 1.5);      // (0, 0)
    vec2 bent = refract(normalize(vec2(0.6, -0.8)), vec2(0.0, 1.0), 0.5);      // sine halved: 0.3
    float unit = bent.x / 0.3 + none.x + none.y;
    vc = unit * kamb * lamb + d * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
