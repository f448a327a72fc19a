#version 410 core
// #if, #elif, #else, #ifdef, #ifndef, defined, nesting, logic and arithmetic.
#define BLINN
#define LEVEL 2
#define MASK (1 << 3)
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
#if LEVEL > 2
    this is not read
#elif LEVEL == 2 && defined(BLINN) && !defined PHONG
    vec3 h = normalize(l + v);
# ifdef PHONG
    h = reflect(-l, n);
# else
#  ifndef BLINN
#   error unreachable
#  endif
    float e = float(MASK) * 10.0;
# endif
#else
    neither is this
#endif
#if (MASK & 8) != 0 && (LEVEL * 3 - 1) % 5 == 0 && ~0 == -1 && (MASK ^ 1) == 9 && 07 + 0x10 == 23
    float d = max(dot(n, l), 0.0);
#else
    float d = 1.0;
#endif
    vc = kamb * lamb + d * kdiff * ldiff + pow(max(dot(n, h), 0.0), e) * kspec * lspec;
    gl_Position = mc * pv;
}
