#version 410 core
in vec4 iamb;
layout (location = 0) out vec4 fc;
void main() { fc = iamb; }
