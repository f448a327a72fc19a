#version 410 core
// Integers where floats are wanted: arguments, operands, initialisers, assignments.
const vec4 pl = vec4(0, 0, 1, 0);
const vec4 lamb = vec4(1, 1, 1, 5) / 5;
const vec4 ldiff = vec4(1, 1, 1, 0);
const vec4 lspec = ldiff * 1;
const vec4 kamb = vec4(6, 0, 0, 10) / 10;
const vec4 kdiff = kamb;
const vec4 kspec = vec4(4, 4, 4, 10) / 10;
const float kshi = 80;
layout (location = 0) in vec4 pv;  // position
in vec4 cv;                        // normal
uniform mat4 mw;                   // model-view
uniform mat4 mc;                   // model-view-projection
uniform mat4 mg;                   // normal matrix
out vec4 vc;                       // vertex colour
void main(void)
{
  vec4 p = mw * pv;                                   // position in eye space
  vec3 v = -normalize(p.xyz / p.w);                   // view vector
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);      // light vector
  vec3 n = normalize((mg * cv).xyz);                  // normal
  float diffuse = 0, specular = 0, two = 2;
  int one = 1;
  diffuse = max(dot(n, l), 0) * one;
  specular = pow(max(dot(n, normalize(l + v)), 0), kshi) + 0 * two;
  vc = kamb * lamb + diffuse * kdiff * ldiff * (two - 1) + specular * kspec * lspec;
  gl_Position = mc * pv;
}
