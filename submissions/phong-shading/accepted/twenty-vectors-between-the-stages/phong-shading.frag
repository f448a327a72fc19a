#version 410 core
const vec4 pl = vec4(1.5, 1.0, -1.0, 1.0);
const vec4 lamb = vec4(0.3, 0.3, 0.35, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 0.9, 0.0);
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.7, 0.15, 0.1, 1.0);
const vec4 kspec = vec4(0.4, 0.35, 0.3, 1.0);
const float kshi = 24.0;

struct Point { vec4 position; vec3 normal; };
in Point at;
in vec4 spare[18];
layout (location = 0) out vec4 fc;

#define position at.position
#define normal at.normal
void main(void)
{
  vec3 v = -normalize(position.xyz / position.w);
  vec3 l = normalize((pl * position.w - position * pl.w).xyz);
  vec3 n = normalize(normal);
  vec3 h = normalize(l + v);

  vec4 iamb = kamb * lamb;
  vec4 idiff = max(dot(n, l), 0.0) * kdiff * ldiff;
  vec4 ispec = pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;
  fc = iamb + idiff + ispec;
  for (int i = 0; i < 18; ++i) fc += 0.0 * spare[i];
}
