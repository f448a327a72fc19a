#version 410 core
// Arrays and matrices inside structs, indexed with a variable.
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
struct Table { vec4 light[3]; vec4 material[3]; mat3 basis; float weight[3]; };
void main(void)
{
  vec4 p = mw * pv;                                   // position in eye space
  vec3 v = -normalize(p.xyz / p.w);                   // view vector
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);      // light vector
  vec3 n = normalize((mg * cv).xyz);                  // normal
  Table t = Table(vec4[3](lamb, ldiff, lspec), vec4[3](kamb, kdiff, kspec), mat3(n, l, normalize(l + v)), float[3](1.0, 0.0, 0.0));
  t.weight[1] = max(dot(t.basis[0], t.basis[1]), 0.0);
  t.weight[2] = pow(max(dot(t.basis[0], t.basis[2]), 0.0), kshi);
  vc = vec4(0.0);
  for (int i = 0; i < t.light.length(); i++)
    vc += t.weight[i] * t.material[i] * t.light[i];
  gl_Position = mc * pv;
}
