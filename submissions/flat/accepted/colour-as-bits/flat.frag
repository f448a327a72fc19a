#version 410 core
flat in uvec3 bits;
layout (location = 0) out vec4 fc;
void main(void)
{
  fc = vec4(uintBitsToFloat(bits), 1.0);
}
