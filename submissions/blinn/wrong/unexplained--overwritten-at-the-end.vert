#version 410 core
layout (location = 0) in vec4 pv;
in vec4 cv;

uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

out vec4 vc;

const vec4 pl = vec4(0.3, -0.7, -3.4, 1.0);
const vec4 lamb = vec4(0.25, 0.25, 0.3, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 0.95, 0.7, 0.0);
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.75, 0.12, 0.08, 1.0);
const vec4 kspec = vec4(0.4, 0.42, 0.45, 1.0);
const float kshi = 40.0;

void main() {
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);

  vec3 h = normalize(l + v);
  float s = pow(max(dot(n, h), 0.0), kshi);
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + s * kspec * lspec;
  vc = cv;
  gl_Position = mc * pv;
}
