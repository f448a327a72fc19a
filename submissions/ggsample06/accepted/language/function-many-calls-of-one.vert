#version 410 core
// One function called with constants, uniforms, attributes, globals and temporaries.
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
vec3 direction(vec4 a) { return normalize(a.xyz); }
vec4 eye;
void main(void)
{
  eye = mw * pv;
  vec3 n = direction(mg * cv), l = direction(pl), v = direction(-eye), h = direction(vec4(l + v, 3.0));
  float straight = dot(direction(vec4(0.0, 0.0, 7.0, 1.0)), l) * direction(vec4(2.0)).x * sqrt(3.0);
  vc = straight * kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;
  gl_Position = mc * pv;
}
