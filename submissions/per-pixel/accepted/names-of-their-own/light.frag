#version 330 core
in vec3 place, outward;
uniform vec3 lightPos, viewPos, lightColor, objectColor;
out vec4 result;
void main()
{
  vec3 n = normalize(outward);
  vec3 l = normalize(lightPos - place);
  vec3 v = normalize(viewPos - place);
  float sum = 0.1;
  sum += max(dot(n, l), 0.0);
  sum += 0.5 * pow(max(dot(v, reflect(-l, n)), 0.0), 32.0);
  result = vec4(sum * lightColor * objectColor, 1.0);
}
