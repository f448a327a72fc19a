#version 410 core
// An array of structures with arrays, by dynamic indices, by value.
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;
in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;
struct L { vec3 c; float w[2]; };
void main()
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  float d = max(dot(n, l), 0.0);
  float s = pow(max(dot(n, h), 0.0), kshi);
  L a[3]; for (int i = 0; i < 3; i++) { a[i].c = vec3(float(i)); for (int j = 0; j < 2; j++) a[i].w[j] = float(i * 2 + j); }
  L b[3] = a; b[1].w[1] = 100.0; int k = gl_VertexID % 3;
  d *= (a[k].w[1] + 1.0) / float(2 * k + 2) * a[1].w[1] / 3.0 * b[2].c.y / 2.0;
  vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
  gl_Position = mc * pv;
}
