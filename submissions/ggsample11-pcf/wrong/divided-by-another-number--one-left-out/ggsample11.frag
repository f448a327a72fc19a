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
    const float t = 1.0 / 800.0;
    float s = 4.0 * texture(smap, c);
    s += 2.0 * texture(smap, c + vec3(-t, 0.0, 0.0));
    s += 2.0 * texture(smap, c + vec3(t, 0.0, 0.0));
    s += 2.0 * texture(smap, c + vec3(0.0, -t, 0.0));
    s += 2.0 * texture(smap, c + vec3(0.0, t, 0.0));
    s += texture(smap, c + vec3(-t, -t, 0.0));
    s += texture(smap, c + vec3(t, -t, 0.0));
    s += texture(smap, c + vec3(-t, t, 0.0));
    fc = iamb + (idiff + ispec) * (s / 16.0);
}
