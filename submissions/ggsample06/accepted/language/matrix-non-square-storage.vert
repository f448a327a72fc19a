#version 410 core
// Non-square matrices as globals, in a struct, passed to functions, indexed.
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
struct Terms { mat3x4 colours; mat4x2 unused; };
const mat3x4 table = mat3x4(kamb * lamb, kdiff * ldiff, kspec * lspec);
mat2x3 pair(vec3 a, vec3 b) { return mat2x3(a, b); }
vec4 mixed(mat3x4 colours, vec3 weights) { return colours * weights; }
void main(void)
{
  vec4 p = mw * pv;                                   // position in eye space
  vec3 v = -normalize(p.xyz / p.w);                   // view vector
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);      // light vector
  vec3 n = normalize((mg * cv).xyz);                  // normal
  Terms terms;
  terms.colours = table;
  terms.colours[1].r = table[1][0];
  terms.unused = mat4x2(1.0);
  mat2x3 lh = pair(l, normalize(l + v));
  vec3 w = vec3(terms.unused[1][1], max(dot(n, lh[0]), 0.0), pow(max(dot(n, lh[1]), 0.0), kshi));
  vc = mixed(terms.colours, w);
  gl_Position = mc * pv;
}
