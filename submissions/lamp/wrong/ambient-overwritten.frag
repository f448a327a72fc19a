#version 330 core
uniform vec3 eye, lamp, paint;
in vec3 at, facing;
out vec4 colour;
const vec3 kd = vec3(0.6, 0.2, 0.2);
const float shininess = 16.0;
void main()
{
  vec3 normal = normalize(facing);
  vec3 toLamp = normalize(lamp - at);
  vec3 toEye = normalize(eye - at);
  float lambert = max(dot(normal, toLamp), 0.0);
  vec3 mirrored = 2.0 * dot(normal, toLamp) * normal - toLamp;
  float highlight = pow(max(dot(mirrored, toEye), 0.0), shininess);
  vec3 sum = vec3(0.05, 0.04, 0.06);
  sum = kd * lambert;
  sum += 0.3 * highlight;
  sum *= paint;
  colour = vec4(sum, 1.0);
}
