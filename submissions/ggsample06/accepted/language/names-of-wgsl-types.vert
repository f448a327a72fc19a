#version 410 core
// Names that are types elsewhere: f32, i32, vec3f, vec5, mat4x4f, float3, float4, half3, f16, atomic, bitcast.
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
struct vec3f { float x, f32; };
float float4(float i32) { return max(i32, 0.0); }
void main(void)
{
  vec4 p = mw * pv;                                   // position in eye space
  vec3 v = -normalize(p.xyz / p.w);                   // view vector
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);      // light vector
  vec3 n = normalize((mg * cv).xyz);                  // normal
  vec3f vec5 = vec3f(dot(n, l), dot(n, normalize(l + v)));
  float u32 = float4(vec5.x), f16 = pow(float4(vec5.f32), kshi), mat4x4f = 1.0, bitcast = 1.0, float3 = 2.0, half3 = 0.5;
  vc = kamb * lamb * mat4x4f * bitcast + u32 * kdiff * ldiff * float3 * half3 + f16 * kspec * lspec;
  gl_Position = mc * pv;
}
