#version 410 core

// The light of the vertices, interpolated.

uniform sampler2DShadow shadowMap;

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 fragPosLight;

layout (location = 0) out vec4 fc;

void main()
{
    vec3 proj = fragPosLight.xyz / fragPosLight.w;
    proj = (proj + 1.0) / 2.0;
    float shadow = texture(shadowMap, proj);
    fc = iamb + shadow * idiff + shadow * ispec;
}
