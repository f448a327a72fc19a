#version 410 core

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;

layout (location = 0) out vec4 fc;

void main(void)
{
  fc = iamb;
}
