#version 410 core
// bitfieldExtract, bitfieldInsert, bitfieldReverse, bitCount, findLSB, findMSB.
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
  uint word = bitfieldInsert(0u, 80u, 4, 8);                       // 0x500
  float shininess = float(bitfieldExtract(word, 4, 8));            // 80
  int minus = bitfieldExtract(0xF0, 4, 4);                         // sign kept: -1
  int five = findLSB(0x60), six = findMSB(0x60), none = findLSB(0), high = findMSB(-1);       // 5, 6, -1, -1
  int count = bitCount(0xFFu) + bitCount(-1);                      // 8 + 32
  uint top = bitfieldReverse(1u) >> 31;                            // 1
  float unit = float(minus * (five - six) * none * high) * float(count) / 40.0 * float(top);
  float d = max(dot(n, l), 0.0) * unit;
  vc = unit * kamb * lamb + d * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.0), shininess) * kspec * lspec;
  gl_Position = mc * pv;
}
