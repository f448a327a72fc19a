#version 410 core
// ++ and --, before and after, on floats, ints, vectors, swizzles and array elements.
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
    int i = 0, order[3];
    order[i++] = 5;            // order[0], i is 1
    order[++i] = 7;            // order[2], i is 2
    order[--i] = 9;            // order[1], i is 1
    float zero = float(order[0]-- - 5) + float(order[0] - 4) + float(order[2]++ - 7) + float(i - 1);
    vec3 c = vec3(max(dot(n, l), 0.0));
    c++;
    vec3 before = c--;         // before is c + 1
    ++c.xy.x;
    --c.x;
    float d = c.x + (before.y - 1.0 - c.y) + zero;
    vc = kamb * lamb + d * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
