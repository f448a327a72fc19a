#version 410 core
in vec4 ambient, diffuse, specular;
out vec4 fc;
void main(void) { fc = ambient + diffuse + specular; }
