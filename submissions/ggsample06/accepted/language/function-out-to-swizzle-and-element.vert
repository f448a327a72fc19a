#version 410 core
// Out arguments that are swizzles, vector components, array elements, struct members and the shader's own outputs.
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
struct Box { vec3 inside; };
void set(out float x, float value) { x = value; }
void set(out vec3 x, vec3 value) { x = value; }
void scale(inout vec2 x, float by) { x *= by; }
void main(void)
{
  vec4 p = mw * pv;                                   // position in eye space
  vec3 v = -normalize(p.xyz / p.w);                   // view vector
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);      // light vector
  vec3 n = normalize((mg * cv).xyz);                  // normal
  float d[2];
  Box box;
  vec4 wide = vec4(1.0, 2.0, 3.0, 4.0);
  int last = 1;
  set(d[0], max(dot(n, l), 0.0));
  set(d[last], pow(max(dot(n, normalize(l + v)), 0.0), kshi));
  set(box.inside, kdiff.rgb * ldiff.rgb);
  scale(wide.zx, 2.0);                              // 2 2 6 4
  set(wide.wyx, vec3(wide.z - 5.0));                // 1 1 6 1
  set(wide[2], 1.0);
  set(vc.rgb, kamb.rgb * lamb.rgb * wide.xyz + d[0] * box.inside + d[1] * kspec.rgb * lspec.rgb);
  set(vc.a, wide.w);
  gl_Position = mc * pv;
}
