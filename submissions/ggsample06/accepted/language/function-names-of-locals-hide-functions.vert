#version 410 core
// Local variables named like built-in functions and like the student's own functions.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
float shade(float x) { return max(x, 0.0); }
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float dot = dot(n, l), reflect = 1.0, mix = 2.0;
    vec3 cross = normalize(l + v);
    float pow = pow(shade(n.x * cross.x + n.y * cross.y + n.z * cross.z), kshi);
    float max = max(dot, 0.0) * mix / (reflect + 1.0);
    {
        float shade = 1.0;
        max *= shade;
    }
    vc = kamb * lamb + max * kdiff * ldiff + pow * kspec * lspec;
    gl_Position = mc * pv;
}
