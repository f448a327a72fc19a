#version 410 core
// A struct declared together with global variables, and one without a name.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
struct Factors { float ambient, diffuse, specular; } factors, zero = Factors(0.0, 0.0, 0.0);
struct { vec3 n, l, h; } unnamed;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    factors = zero;
    factors.ambient++;
    unnamed.n = n; unnamed.l = l; unnamed.h = normalize(l + v);
    factors.diffuse += max(dot(unnamed.n, unnamed.l), 0.0);
    factors.specular = pow(max(dot(unnamed.n, unnamed.h), 0.0), kshi);
    vc = factors.ambient * kamb * lamb + factors.diffuse * kdiff * ldiff + factors.specular * kspec * lspec;
    gl_Position = mc * pv;
}
