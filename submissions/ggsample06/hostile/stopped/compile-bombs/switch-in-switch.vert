#version 410 core
// Cases in cases.
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
  int k = gl_VertexID;
  float s = 0.0;
  switch (k) {
  case 0: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 1: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 2: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 3: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 4: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 5: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 6: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 7: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 8: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 9: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 10: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 11: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 12: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 13: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 14: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 15: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 16: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 17: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 18: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  case 19: switch (k + 1) { case 0: s += 0.5; case 1: s += 1.5; case 2: s += 2.5; case 3: s += 3.5; case 4: s += 4.5; case 5: s += 5.5; case 6: s += 6.5; case 7: s += 7.5; case 8: s += 8.5; case 9: s += 9.5; case 10: s += 10.5; case 11: s += 11.5; case 12: s += 12.5; case 13: s += 13.5; case 14: s += 14.5; case 15: s += 15.5; case 16: s += 16.5; case 17: s += 17.5; case 18: s += 18.5; case 19: s += 19.5; }
  }
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec + 0.0 * s;
  gl_Position = mc * pv;
}
