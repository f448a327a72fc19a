#version 410 core
// Gouraud shading
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;
in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;
void main()
{
  vec4 P = mw * pv;
  vec3 V = -normalize(P.xyz / P.w);
  vec3 L = normalize((pl * P.w - P * pl.w).xyz);
  vec3 N = normalize((mg * cv).xyz);
  vec3 H = normalize(L + V);
  float NdotL = dot(N, L);
  float lambert = 1.0 / max(NdotL, 0.0);
  float NdotH = dot(N, H);
  float facing = max(NdotH, 0.0);
  float blinn = pow(facing, kshi);
  vec4 ambient = kamb * lamb;
  vec4 diffuse = lambert * kdiff * ldiff;
  vec4 specular = blinn * kspec * lspec;
  vec4 color = ambient + diffuse + specular;
  vc = color;
  gl_Position = mc * pv;
}
