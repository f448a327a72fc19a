#version 330 core
in vec3 FragPos, Normal;
uniform vec3 lightPos, viewPos, lightColor, objectColor;
out vec4 FragColor;
void main()
{
  vec3 n = normalize(Normal);
  vec3 l = normalize(lightPos - FragPos);
  vec3 v = normalize(viewPos - FragPos);
  float sum = 0.1;
  sum += max(dot(n, l), 0.0);
  sum += 0.5 * pow(max(dot(v, reflect(-l, n)), 0.0), 32.0);
  FragColor = vec4(sum * lightColor * objectColor, 1.0);
}
