#version 330 core
const vec4 pl = vec4(1.5, 1.0, -1.0, 1.0);
const vec4 lamb = vec4(0.3, 0.3, 0.35, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 0.9, 0.0);
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.7, 0.15, 0.1, 1.0);
const vec4 kspec = vec4(0.4, 0.35, 0.3, 1.0);
const float kshi = 24.0;

in Surface
{
  vec3 point;
  vec3 upright;
} given;
out vec4 fc;

// 陰影付けの式
vec3 illuminate(vec3 P, vec3 N, vec3 lamp)
{
  vec3 toLamp = normalize(lamp - P);
  vec3 toEye = normalize(-P);
  vec3 color = kamb.rgb * lamb.rgb;
  float d = dot(N, toLamp);
  if (d > 0.0) color += d * kdiff.rgb * ldiff.rgb;
  float s = clamp(dot(N, normalize(toLamp + toEye)), 0.0, 1.0);
  color += pow(s, kshi) * kspec.rgb * lspec.rgb;
  return color;
}

void main()
{
  fc = vec4(illuminate(given.point, normalize(given.upright), pl.yzx / pl.w), 1.0);
}
