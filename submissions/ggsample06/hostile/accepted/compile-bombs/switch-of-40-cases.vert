#version 410 core
// A switch of forty cases is fine.
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;
layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

void main(void)
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  float s = 0.0;
  switch (gl_VertexID)
  {
  case 0: s += 0.5; break;
  case 1: s += 1.5; break;
  case 2: s += 2.5; break;
  case 3: s += 3.5; break;
  case 4: s += 4.5; break;
  case 5: s += 5.5; break;
  case 6: s += 6.5; break;
  case 7: s += 7.5; break;
  case 8: s += 8.5; break;
  case 9: s += 9.5; break;
  case 10: s += 10.5; break;
  case 11: s += 11.5; break;
  case 12: s += 12.5; break;
  case 13: s += 13.5; break;
  case 14: s += 14.5; break;
  case 15: s += 15.5; break;
  case 16: s += 16.5; break;
  case 17: s += 17.5; break;
  case 18: s += 18.5; break;
  case 19: s += 19.5; break;
  case 20: s += 20.5; break;
  case 21: s += 21.5; break;
  case 22: s += 22.5; break;
  case 23: s += 23.5; break;
  case 24: s += 24.5; break;
  case 25: s += 25.5; break;
  case 26: s += 26.5; break;
  case 27: s += 27.5; break;
  case 28: s += 28.5; break;
  case 29: s += 29.5; break;
  case 30: s += 30.5; break;
  case 31: s += 31.5; break;
  case 32: s += 32.5; break;
  case 33: s += 33.5; break;
  case 34: s += 34.5; break;
  case 35: s += 35.5; break;
  case 36: s += 36.5; break;
  case 37: s += 37.5; break;
  case 38: s += 38.5; break;
  case 39: s += 39.5; break;
  }
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec + 0.0 * s;
  gl_Position = mc * pv;
}
