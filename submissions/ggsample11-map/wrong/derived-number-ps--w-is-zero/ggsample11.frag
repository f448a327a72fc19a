#version 410 core
uniform sampler2DShadow smap;
in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 posL;
layout (location = 0) out vec4 fc;
void main()
{
    vec3 c = posL.xyz / posL.w;
    c = c * 0.5 + 0.5;
    float s = texture(smap, c);
    vec4 light = idiff + ispec;
    fc = iamb + light * s;
}
