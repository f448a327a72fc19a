#version 410 core
// A struct of unlike members: bool, int, uint, double, ivec, mat2x3, arrays.
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
struct Odd { bool yes; int i; uint u; double d; ivec2 pair; mat2x3 lh; bvec2 flags; float list[2]; };
void main(void)
{
  vec4 p = mw * pv;                                   // position in eye space
  vec3 v = -normalize(p.xyz / p.w);                   // view vector
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);      // light vector
  vec3 n = normalize((mg * cv).xyz);                  // normal
  Odd odd = Odd(true, 2, 3u, 0.5lf, ivec2(4, 5), mat2x3(l, normalize(l + v)), bvec2(false, true), float[2](1.0, 80.0));
  float unit = float(odd.i) * float(odd.u) * float(odd.d) / 3.0 * float(odd.pair.y - odd.pair.x);
  if (!odd.yes || odd.flags.x || !odd.flags.y) unit = 0.0;
  odd.list[0] *= max(dot(n, odd.lh[0]), 0.0);
  vc = unit * kamb * lamb + odd.list[0] * kdiff * ldiff + pow(max(dot(n, odd.lh[1]), 0.0), odd.list[1]) * kspec * lspec;
  gl_Position = mc * pv;
}
