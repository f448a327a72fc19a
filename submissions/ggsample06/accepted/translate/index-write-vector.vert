#version 410 core
// A component written by a dynamic index, in a vector, a matrix and an array of both.
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

void main()
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  float d = max(dot(n, l), 0.0);
  float s = pow(max(dot(n, h), 0.0), kshi);
  int k = gl_VertexID % 3;
  vec4 q = vec4(0.0); q[k] = 1.0; q[(k + 1) % 3] += 1.0;
  mat3 m = mat3(0.0); m[k][(k + 1) % 3] = 2.0; m[(k + 2) % 3].yz = vec2(1.0);
  vec2 a[3]; a[0] = a[1] = a[2] = vec2(0.0); a[k][k % 2] = 3.0;
  d *= (q.x + q.y + q.z) / 2.0 * (dot(m[0], vec3(1.0)) + dot(m[1], vec3(1.0)) + dot(m[2], vec3(1.0))) / 4.0;
  d *= (a[0] + a[1] + a[2])[k % 2] / 3.0;
  vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
  gl_Position = mc * pv;
}
