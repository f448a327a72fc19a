#version 410 core
// round, roundEven, trunc, sign, floor, ceil of negative and halves.
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
  vec4 q = vec4(-2.5, 2.5, -0.4, 1.5) * pv.w; d *= float(roundEven(q) == vec4(-2.0, 2.0, 0.0, 2.0) && trunc(q) == vec4(-2.0, 2.0, 0.0, 1.0) && sign(q) == vec4(-1.0, 1.0, -1.0, 1.0) && floor(q) == vec4(-3.0, 2.0, -1.0, 1.0) && ceil(q) == vec4(-2.0, 3.0, 0.0, 2.0));
  vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
  gl_Position = mc * pv;
}
