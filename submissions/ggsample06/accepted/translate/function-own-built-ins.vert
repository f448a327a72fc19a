#version 410 core
// Functions of the student that are called as built-in ones, used beside those with other types.
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
float max(float a, float b) { if (a > b) return a; return b; }
vec3 normalize(vec3 a) { return a * inversesqrt(dot(a, a)); }
float dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
float pow(float a, float b) { return a <= 0.0 ? 0.0 : exp2(b * log2(a)); }
float clamp(float x) { return min(x, 1.0); }
float mix(float x) { return x; }
float length(float x) { return 2.0 * x; }
void main()
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  float d = max(dot(n, l), 0.0);
  float s = pow(max(dot(n, h), 0.0), kshi);
  vec3 h2 = normalize(l + v); s = pow(max(dot(n, h2), 0.0), kshi); d = clamp(d); d *= mix(1.0) * length(4.0) / 8.0;
  vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
  gl_Position = mc * pv;
}
