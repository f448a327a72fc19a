#version 410 core
uniform sampler2D shadowMap;
in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 FragPosLightSpace;
layout (location = 0) out vec4 fc;
float ShadowCalculation(vec4 fragPos)
{
    vec3 projCoords = fragPos.xyz / fragPos.w;
    projCoords = projCoords * 0.5 + 0.5;
    float closestDepth = texture(shadowMap, projCoords.xy).r;
    float currentDepth = fragPos.z;
    float bias = 0.001;
    float shadow = currentDepth - bias > closestDepth ? 1.0 : 0.0;
    return shadow;
}
void main()
{
    float shadow = ShadowCalculation(FragPosLightSpace);
    fc = iamb + (1.0 - shadow) * (idiff + ispec);
}
