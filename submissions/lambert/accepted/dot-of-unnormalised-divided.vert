#version 410 core

// shukudai: lambert.vert

const vec4 pl = vec4(1.5, 0.5, 2.0, 0.0);  // kougen no ichi
const vec4 lamb = vec4(0.25, 0.25, 0.3, 1.0);  // kankyoukou
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);  // kakusan hansha kou
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);  // kankyou keisuu
const vec4 kdiff = vec4(0.75, 0.12, 0.08, 1.0);  // kakusan keisuu

// nyuuryoku
layout (location = 0) in vec4 pv;
in vec4 cv;

uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

// shutsuryoku
out vec4 vc;

void main() {
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);

  vec3 m = (mg * cv).xyz, q = (pl * p.w - p * pl.w).xyz;
  float d = max(dot(m, q) / (length(m) * length(q)), 0.0);
  vc = lamb * kamb + ldiff * kdiff * d;
  gl_Position = mc * pv;
}
