#version 410 core
flat in vec4 vc;
in vec4 gradient;
layout (location = 0) out vec4 fc;
void main(void)
{
  fc = vc;
}
