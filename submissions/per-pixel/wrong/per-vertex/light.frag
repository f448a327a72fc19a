#version 330 core
in float sum;
uniform vec3 lightColor, objectColor;
out vec4 FragColor;
void main()
{
  FragColor = vec4(sum * lightColor * objectColor, 1.0);
}
