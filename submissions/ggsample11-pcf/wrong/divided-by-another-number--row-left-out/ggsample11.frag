#version 410 core
uniform sampler2DShadow smap;
in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 posL;
layout (location = 0) out vec4 fc;
void main()
{
    vec3 c = posL.xyz / posL.w * 0.5 + 0.5;
    vec2 d = 1.0 / vec2(textureSize(smap, 0));
    float s = 0.0;
    for (int i = -1; i < 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
            vec2 offset = vec2(float(i), float(j)) * d;
            s += texture(smap, vec3(c.xy + offset, c.z));
        }
    }
    s /= 9.0;
    fc = iamb + (idiff + ispec) * s;
}
