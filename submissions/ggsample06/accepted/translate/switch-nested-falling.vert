#version 410 core
// A switch that falls through inside a case that falls through.
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
  int k = 0;
  switch (int(pv.w))
  {
  case 1:
    switch (int(cv.w) + 1) { case 2: k += 1; case 3: k += 2; break; case 4: k = 50; }
  case 7: k += 4;
    switch (k) { case 7: k += 8; default: k += 16; }
  case 8: break;
  case 9: k = 99;
  }
  d *= float(k) / 31.0;
  vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
  gl_Position = mc * pv;
}
