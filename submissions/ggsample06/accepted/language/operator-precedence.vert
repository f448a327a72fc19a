#version 410 core
// Precedence and associativity of unary, arithmetic, shift, relational and bit operators.
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
    int a = 2 + 3 * 4 - 10 / 2 % 3;           // 2 + 12 - 2 = 12
    int b = 1 << 2 + 1 | 4 & 6 ^ 1;           // 8 | (4 ^ 1) = 13
    int c = - -3 - ~0 - +1;                   // 3 + 1 - 1 = 3
    float f = 8.0 / 4.0 / 2.0;                // 1
    bool t = 1 + 1 == 2 && 3 > 2 == true && !(a < b) == false;
    float d = max(dot(n, l), 0.0) * float(b - a) * f;
    if (!t || c != 3) d = 1.0;
    vc = kamb * lamb + d * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
