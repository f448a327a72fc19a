#version 410 core
// Uniforms of the student's own with initial values, which the program never sets.
uniform vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
uniform vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0), ldiff = vec4(1.0), lspec = vec4(1.0);
uniform vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
uniform vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
uniform vec4 kspec = vec4(vec3(0.4), 1.0);
uniform float kshi = 80.0;
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
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
  gl_Position = mc * pv;
}
