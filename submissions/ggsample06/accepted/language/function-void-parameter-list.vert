#version 410 core
// main() without void, return type void functions that return early, nested calls in arguments.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
vec4 sum = vec4(0.0);
void add(vec4 term, bool wanted) { if (!wanted) return; sum += term; }
vec4 once(vec4 x) { add(x, true); return x; }
void main(
)
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    add(once(kamb * lamb), false);
    add(max(dot(n, l), 0.0) * kdiff * ldiff, sum.r > 0.0);
    add(once(pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec), false);
    vc = sum;
    gl_Position = mc * pv;
}
