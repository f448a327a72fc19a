#version 330
in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;
const vec4 pl = vec4(0, 0, 1, 0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1);
const vec4 ldiff = vec4(1, 1, 1, 0);
const vec4 lspec = vec4(1, 1, 1, 0);
const vec4 kamb = vec4(0.6, 0, 0, 1);
const vec4 kdiff = vec4(0.6, 0, 0, 1);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1);
const float kshi = 80;

void main() {
  mat4 toObject = inverse(mw);
  vec3 eye = (toObject * vec4(0, 0, 0, 1)).xyz;
  vec3 light = normalize((toObject * pl).xyz);
  vec3 normal = normalize(cv.xyz);
  vec3 view = normalize(eye - pv.xyz);
  vec3 halfway = normalize(light + view);
  vc = kamb * lamb
     + max(dot(normal, light), 0) * kdiff * ldiff
     + pow(max(dot(normal, halfway), 0), kshi) * kspec * lspec;
  gl_Position = mc * pv;
}
