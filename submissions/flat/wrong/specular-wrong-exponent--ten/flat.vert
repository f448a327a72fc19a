#version 330 core
const vec4 pl = vec4(2.0, 1.5, 1.0, 0.0);
const vec4 lamb = vec4(0.3, 0.3, 0.35, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 0.9, 0.0);
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.7, 0.15, 0.1, 1.0);
const vec4 kspec = vec4(0.4, 0.35, 0.3, 1.0);
const float kshi = 24.0;

in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

flat out vec3 faceColor;

// 陰影付けの式
vec3 illuminate(vec3 normal, vec3 light, vec3 view)
{
  vec3 color = kamb.rgb * lamb.rgb;
  float d = dot(normal, light);
  if (d > 0.0) color += d * kdiff.rgb * ldiff.rgb;
  vec3 halfway = normalize(light + view);
  float s = clamp(dot(normal, halfway), 0.0, 1.0);
  color += pow(s, 10.0) * kspec.rgb * lspec.rgb;
  return color;
}

void main()
{
  vec4 eye = mw * pv;
  faceColor = illuminate(normalize(mat3(mg) * cv.xyz), normalize(pl.xyz), normalize(-eye.xyz));
  gl_Position = mc * pv;
}
