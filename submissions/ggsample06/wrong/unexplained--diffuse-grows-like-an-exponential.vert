#version 410 core
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
  vec4 pos = mw * pv;
  vec3 view = -normalize(pos.xyz / pos.w);
  vec3 light = normalize((pl * pos.w - pos * pl.w).xyz);
  vec3 nrm = normalize((mg * cv).xyz);
  vec3 hv = normalize(light + view);
  float d = dot(nrm, light);
  float s = pow((max((dot(nrm, hv)), 0.0)), kshi);
  vc = kamb * lamb;
  vc += (exp(d) - 1.0) * kdiff * ldiff;
  vc += s * kspec * lspec;
  gl_Position = mc * pv;
}
