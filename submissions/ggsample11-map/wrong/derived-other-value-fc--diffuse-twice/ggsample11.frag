#version 410 core

uniform sampler2DShadow depth;

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 ps;

layout (location = 0) out vec4 fc;

void main()
{
    vec3 c = ps.xyz / ps.w;
    float s = texture(depth, 0.5 + 0.5 * c);
    vec4 direct = idiff + idiff;
    fc = iamb + direct * s;
}
