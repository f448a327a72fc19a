#version 410 core
// Decimal, octal, hexadecimal and unsigned integer literals.
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
  vec3 h = normalize(l + v);
  int octal = 0120;            // 80
  int hexadecimal = 0x50;      // 80
  uint suffixed = 80u, Hex = 0X50U, oct = 0120u;
  // Read as decimal, 0120 would be 120: the difference is 40 and the diffuse term would go.
  float diffuse = max(dot(n, l), 0.0) - float(octal - hexadecimal) - float(suffixed - Hex) - float(oct - 80u);
  float specular = pow(max(dot(n, h), 0.0), float(octal));
  vc = kamb * lamb + diffuse * kdiff * ldiff + specular * kspec * lspec;
  gl_Position = mc * pv;
}
