#version 410 core
in ivec4 vc;
layout (location = 0) out vec4 fc;
void main(void)
{
  fc = vec4(vc) / 255.0;
}
