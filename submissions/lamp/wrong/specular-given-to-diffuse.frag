#version 330 core
uniform vec3 eye, lamp, paint;
in vec3 at, facing;
out vec4 colour;
void main()
{
  vec3 n = normalize(facing);
  vec3 l = normalize(lamp - at);
  vec3 diffuse = vec3(0.0);
  vec3 specular = vec3(0.0);
  diffuse = vec3(0.6, 0.2, 0.2) * max(dot(n, l), 0.0);
  diffuse = vec3(0.3) * pow(max(dot(reflect(-l, n), normalize(eye - at)), 0.0), 16.0);
  colour = vec4(vec3(0.05, 0.04, 0.06) + diffuse + specular, 1.0) * vec4(paint, 1.0);
}
