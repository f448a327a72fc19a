#version 330 core
in vec3 toLight, toEye, Normal;
uniform vec3 lightColor, objectColor;
out vec4 FragColor;
void main()
{
  vec3 n = normalize(Normal);
  vec3 l = normalize(toLight);
  vec3 v = normalize(toEye);
  float sum = 0.1;
  sum += max(dot(n, l), 0.0);
  sum += 0.5 * pow(max(dot(v, reflect(-l, n)), 0.0), 32.0);
  FragColor = vec4(sum * lightColor * objectColor, 1.0);
}
