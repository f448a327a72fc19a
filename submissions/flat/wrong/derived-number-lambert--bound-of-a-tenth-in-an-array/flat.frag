#version 410 core
flat in vec4 terms[3];
layout (location = 0) out vec4 fc;
void main(void)
{
  fc = vec4(0.0);
  for (int i = 0; i < 3; i++)
    fc += terms[i];
}
