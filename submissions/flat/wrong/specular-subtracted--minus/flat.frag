#version 410 core
flat in vec4 vc;
layout (location = 0) out vec4 fc;
void main(void)
{
  fc = vc;
}
