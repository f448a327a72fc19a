#version 330 core
flat in vec3 faceColor;
out vec4 fc;
void main()
{
  fc = vec4(faceColor, 1.0);
}
