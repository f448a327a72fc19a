#version 410 core
flat in vec4 vc;
layout (location = 0) out vec4 fc;
void main(void)
{
  fc = vc;
  while (fc.a > -1.0) fc += vec4(0.0, 0.0, 0.0, 1.0);
}
