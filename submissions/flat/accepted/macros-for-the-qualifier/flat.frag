#version 410 core
#define PER_FACE flat
PER_FACE in vec4 vc;
layout (location = 0) out vec4 fc;
void main(void)
{
  fc = vc;
}
