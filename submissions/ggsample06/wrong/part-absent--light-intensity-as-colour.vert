#version 410 core
// Illumination equation, slide 31
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
float positive(float x) { return max(x, 0.0); }
void main()
{
  gl_Position = mc * pv;
  vec4 q = mw * pv;
  vec3 e = -normalize(q.xyz / q.w);
  vec3 w = normalize((pl * q.w - q * pl.w).xyz);
  vec3 m = normalize((mg * cv).xyz);
  vec3 b = normalize(w + e);
  vec4 a = kamb * lamb;
  vec4 d = (positive((dot(m, w)))) * kdiff * ldiff;
  vec4 s = (pow((positive((dot(m, b)))), kshi)) * kspec * lspec;
  vc = ldiff;
}
