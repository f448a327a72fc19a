#version 410 core
// Global constants computed by built-in functions and operators.
const float pi = acos(-1.0);
const vec4 pl = vec4(normalize(vec3(0.0, 0.0, 5.0)), sin(0.0));
const float kshi = pow(2.0, 6.0) + exp2(4.0);                           // 64 + 16
const vec4 lamb = vec4(vec3(fract(1.2)), cos(0.0));
const vec4 ldiff = mix(vec4(0.0), vec4(2.0), 0.5);
const vec4 kamb = clamp(vec4(0.6, -1.0, -2.0, 7.0), 0.0, 1.0);
const vec4 kdiff = max(kamb, vec4(0.0)) * sin(pi / 2.0);
const vec4 kspec = vec4(vec3(length(vec2(0.24, 0.32))), 1.0);
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
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * ldiff;
  gl_Position = mc * pv;
}
