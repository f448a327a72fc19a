#version 410 core
// Every loop is left from within.
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
  while (true) { if (n.x > 0.5) break; s += n.y; while (true) { if (n.x > 1.5) break; s += n.y; while (true) { if (n.x > 2.5) break; s += n.y; while (true) { if (n.x > 3.5) break; s += n.y; while (true) { if (n.x > 4.5) break; s += n.y; while (true) { if (n.x > 5.5) break; s += n.y; while (true) { if (n.x > 6.5) break; s += n.y; while (true) { if (n.x > 7.5) break; s += n.y; while (true) { if (n.x > 8.5) break; s += n.y; while (true) { if (n.x > 9.5) break; s += n.y; while (true) { if (n.x > 10.5) break; s += n.y; while (true) { if (n.x > 11.5) break; s += n.y; while (true) { if (n.x > 12.5) break; s += n.y; while (true) { if (n.x > 13.5) break; s += n.y; while (true) { if (n.x > 14.5) break; s += n.y; while (true) { if (n.x > 15.5) break; s += n.y; while (true) { if (n.x > 16.5) break; s += n.y; while (true) { if (n.x > 17.5) break; s += n.y; while (true) { if (n.x > 18.5) break; s += n.y; while (true) { if (n.x > 19.5) break; s += n.y; while (true) { if (n.x > 20.5) break; s += n.y; while (true) { if (n.x > 21.5) break; s += n.y; while (true) { if (n.x > 22.5) break; s += n.y; while (true) { if (n.x > 23.5) break; s += n.y; s += 1.0; break; }break; }break; }break; }break; }break; }break; }break; }break; }break; }break; }break; }break; }break; }break; }break; }break; }break; }break; }break; }break; }break; }break; }break; }
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec + 0.0 * s;
  gl_Position = mc * pv;
}
