#version 330 core
in vec4 lit;
uniform sampler2D grain;
out vec4 colour;
void main() { colour = vec4(texture(grain, lit.xy).rgb * lit.z, 1.0); }
