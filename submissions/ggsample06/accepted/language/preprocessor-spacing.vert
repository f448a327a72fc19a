#version 410 core
// Directives with blanks and tabs around the #, comments in them, and no blank where none is needed.
  #  define   D   max(dot(n, l), 0.0)   // with a comment
	#	define/* here */S/* and here */pow(max(dot(n, normalize(l + v)), 0.0), kshi)
#define EMPTY
#/* even here */define ONE 1.0
#if/**/1
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
#endif/**/
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
EMPTY void EMPTY main EMPTY (EMPTY) EMPTY
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    vc=ONE*kamb*lamb+D*kdiff*ldiff+S*kspec*lspec;gl_Position=mc*pv;
}
