#version 410 core
flat in vec3 vc;
layout (location = 0) out vec4 fc;
void main(void)
{
  fc = vec4(vc, 1.0);
}
