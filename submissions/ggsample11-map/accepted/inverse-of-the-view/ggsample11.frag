#version 410 core

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 s;
uniform sampler2DShadow dt;

layout (location = 0) out vec4 fc;

void main(void)
{
  fc = iamb + (idiff + ispec) * texture(dt, 0.5 * s.xyz / s.w + 0.5);
}
