#version 410 core
// Code after return, break and continue, and code under a false condition.
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);     // light position
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);   // ambient intensity
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);  // diffuse intensity
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);  // specular intensity
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);   // ambient reflectance
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);  // diffuse reflectance
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);  // specular reflectance
const float kshi = 80.0;                      // shininess
layout (location = 0) in vec4 pv;  // position
in vec4 cv;                        // normal
uniform mat4 mw;                   // model-view
uniform mat4 mc;                   // model-view-projection
uniform mat4 mg;                   // normal matrix
out vec4 vc;                       // vertex colour
float shade(float x)
{
  return max(x, 0.0);
  x = 5.0;
  return x;
}
void main(void)
{
  vec4 p = mw * pv;                                   // position in eye space
  vec3 v = -normalize(p.xyz / p.w);                   // view vector
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);      // light vector
  vec3 n = normalize((mg * cv).xyz);                  // normal
  float d = 0.0;
  for (int i = 0; i < 2; i++)
  {
    if (i == 0) { continue; d += 9.0; }
    d = shade(dot(n, l));
    break;
    d = 7.0;
  }
  if (false) { while (true) { d += 1.0; } }
  vc = kamb * lamb + d * kdiff * ldiff + pow(shade(dot(n, normalize(l + v))), kshi) * kspec * lspec;
  gl_Position = mc * pv;
  return;
  vc = vec4(0.0, 1.0, 0.0, 1.0);
}
