#version 330 core
in vec3 FragPos, Normal;
uniform vec3 lightPos, viewPos, lightColor, objectColor;
out vec4 FragColor;
void main()
{
  FragColor = vec4(objectColor, 1.0);
}
