#version 410 core

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 pt;
uniform sampler2DShadow dt;

layout (location = 0) out vec4 fc;

void main(void)
{
  vec3 c = pt.xyz / pt.w * 0.5 + 0.5;
  float s = texture(dt, c);
  fc = iamb + (idiff + ispec) * s;
}
