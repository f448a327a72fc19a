#version 410 core
// Function-like macros: several parameters, macros as arguments, parentheses inside arguments, a name without a call.
#define POSITIVE(x) max((x), 0.0)
#define TERM(weight, k, l) ((weight) * (k) * (l))
#define DOT(a, b) dot(a, b)
#define UNIT(x) normalize(x)
#define NOTHING()
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);     // light position
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);   // ambient intensity
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);  // diffuse intensity
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);  // specular intensity
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);   // ambient reflectance
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);  // diffuse reflectance
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);  // specular reflectance
const float kshi = 80.0;                      // shininess
layout (location = 0) in vec4 pv;  // position
in vec4 cv;                        // normal
uniform mat4 mw;                   // model-view
uniform mat4 mc;                   // model-view-projection
uniform mat4 mg;                   // normal matrix
out vec4 vc;                       // vertex colour
float TERMS = 1.0;
float POSITIVE_ = 1.0;
void main(void)
{
  vec4 p = mw * pv;                                   // position in eye space
  vec3 v = -normalize(p.xyz / p.w);                   // view vector
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);      // light vector
  vec3 n = normalize((mg * cv).xyz);                  // normal
  NOTHING()
  float UNIT = 1.0;                       // no parenthesis follows: no call of the macro
  vc = TERM(UNIT, kamb, lamb) + TERM(POSITIVE(DOT(n, (l))), kdiff, ldiff)
     + TERM (pow(POSITIVE(DOT(n, UNIT(l + v))), kshi), kspec, lspec) * TERMS * POSITIVE_;
  gl_Position = mc * pv;
}
