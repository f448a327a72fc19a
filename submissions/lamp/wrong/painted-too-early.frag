#version 330 core
uniform vec3 eye, lamp, paint;
in vec3 at, facing;
out vec4 colour;
vec3 shine(vec3 n, vec3 l)
{
  return vec3(0.3) * pow(max(dot(reflect(-l, n), normalize(eye - at)), 0.0), 16.0);
}
void main()
{
  vec3 n = normalize(facing), l = normalize(lamp - at);
  vec3 sum = vec3(0.05, 0.04, 0.06) + shine(n, l);
  sum *= paint;
  sum += vec3(0.6, 0.2, 0.2) * max(dot(n, l), 0.0);
  colour = vec4(sum, 1.0);
}
