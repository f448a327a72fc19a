#version 410 core
// continue in a do-while goes to the condition, not to the top.
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
    int i = 0, sum = 0;
    do {
        i++;
        if (i % 2 == 0) continue;
        sum += i;                          // 1 + 3 + 5
    } while (i < 5);
    int once = 0;
    do { once++; continue; } while (once > 5);
    float d = max(dot(n, l), 0.0) * float(sum) / 9.0 * float(once);
    vc = kamb * lamb + d * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
