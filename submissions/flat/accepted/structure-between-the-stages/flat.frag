#version 410 core
struct Terms { vec4 ambient, diffuse, specular; };
flat in Terms terms;
layout (location = 0) out vec4 fc;
void main(void)
{
  fc = terms.ambient + terms.diffuse + terms.specular;
}
