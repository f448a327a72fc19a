#version 410 core
// Built-in functions on vec4 in place of scalars: the terms side by side.
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
void main(void)
{
  vec4 p = mw * pv;                                   // position in eye space
  vec3 v = -normalize(p.xyz / p.w);                   // view vector
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);      // light vector
  vec3 n = normalize((mg * cv).xyz);                  // normal
  vec4 x = vec4(dot(n, l), dot(n, normalize(l + v)), 1.0, -1.0);
  x = pow(max(x, vec4(1e-9, 1e-9, 0.25, 0.25)), vec4(1.0, kshi, 0.5, 2.0));      // d, s, 1/2 -> sqrt(1) ...
  x = sign(x) * abs(x) + floor(vec4(0.0, 0.0, 0.5, 0.5));
  vec4 unit = mix(vec4(0.0), vec4(2.0), vec4(0.5)) * exp2(vec4(0.0)) * cos(vec4(0.0));
  vc = unit * kamb * lamb + x.x * kdiff * ldiff + x.y * kspec * lspec + (x.z - 1.0) * (x.w - 0.0625) ;
  gl_Position = mc * pv;
}
