#version 410 core
// min, max, clamp, mix, step, smoothstep with scalar and vector limits.
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
  vec2 x = vec2(dot(n, l), dot(n, normalize(l + v)));
  x = max(x, 0.0);
  x = min(x, vec2(1.0));
  x = clamp(x, vec2(0.0), vec2(1.0)) * step(0.0, x);
  float d = mix(0.0, 4.0, x.x) / mix(2.0, 6.0, 0.5);
  // smoothstep(0, 1, .25) = 3/16 - 2/64 = 5/32
  float unit = smoothstep(0.0, 1.0, 0.25) * 6.4 + smoothstep(1.0, 2.0, 0.5) + step(3.0, 2.0) + float(min(3, -2) + max(2u, 1u));
  vc = unit * kamb * lamb + d * kdiff * ldiff + pow(x.y, kshi) * kspec * lspec;
  gl_Position = mc * pv;
}
