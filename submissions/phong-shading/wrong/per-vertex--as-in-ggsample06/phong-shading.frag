#version 410 core
in vec4 vc;
out vec4 fc;
void main(void) { fc = vc; }
