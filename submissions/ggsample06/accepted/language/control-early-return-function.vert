#version 410 core
// Functions that return from inside loops and branches.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
float positive(float x)
{
    if (x > 0.0) return x;
    return 0.0;
}
int first_above(float limits[4], float x)
{
    for (int i = 0; i < 4; i++) {
        if (limits[i] > x) return i;
    }
    return -1;
}
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float steps[4] = float[](0.25, 0.5, 0.75, 2.0);
    float d = positive(dot(n, l)), s = positive(dot(n, normalize(l + v)));
    int k = first_above(steps, d), none = first_above(steps, 3.0);
    d = k == 0 ? d : k == 3 ? d * -float(none) : d * float(k) / float(k);
    vc = kamb * lamb + d * kdiff * ldiff + pow(s, kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
