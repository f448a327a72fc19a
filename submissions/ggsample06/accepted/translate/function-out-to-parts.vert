#version 410 core
// out and inout arguments that are swizzles, elements, members and components by a dynamic index.
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
struct S { vec3 v; };
void put(out vec2 v, float x) { v = vec2(x, x); v += vec2(0.0); }
void put1(out float x) { x = 2.0; }
void add(inout float x) { x += 2.0; }
void main()
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  float d = max(dot(n, l), 0.0);
  float s = pow(max(dot(n, h), 0.0), kshi);
  vec4 q = vec4(0.0); float a[2]; S t; int k = gl_VertexID % 2; a[0] = a[1] = 0.0; t.v = vec3(5.0);
  put(q.zx, 1.0); put1(a[k]); put1(t.v.y); put1(q[1 + 2 * k]); add(q.z);
  d *= q.x * q.z / 3.0 * a[k] / 2.0 * t.v.y / 2.0 * q[1 + 2 * k] / 2.0;
  vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
  gl_Position = mc * pv;
}
