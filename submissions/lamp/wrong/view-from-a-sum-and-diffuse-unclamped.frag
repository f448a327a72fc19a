#version 330 core
uniform vec3 eye, lamp, paint;
in vec3 at, facing;
out vec4 colour;
void main()
{
  vec3 n = normalize(facing);
  vec3 v = normalize(eye + at);
  vec3 l = normalize(lamp - at);
  vec3 r = reflect(-l, n);
  vec3 ambient = vec3(0.05, 0.04, 0.06);
  vec3 diffuse = vec3(0.6, 0.2, 0.2) * dot(n, l);
  vec3 specular = vec3(0.3) * pow(max(dot(r, v), 0.0), 16.0);
  colour = vec4((ambient + diffuse + specular) * paint, 1.0);
}
