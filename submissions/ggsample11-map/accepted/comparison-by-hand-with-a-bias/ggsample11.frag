#version 410 core

// The light of the vertices, interpolated.

uniform sampler2D shadowMap;

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 FragPosLightSpace;

layout (location = 0) out vec4 fc;

// 1 in the shadow
float ShadowCalculation(vec4 fragPosLightSpace)
{
    vec3 projCoords = fragPosLightSpace.xyz / fragPosLightSpace.w;
    projCoords = projCoords * 0.5 + 0.5;
    float closestDepth = texture(shadowMap, projCoords.xy).r;
    float currentDepth = projCoords.z;
    float bias = 0.003;
    float shadow = currentDepth - bias > closestDepth ? 1.0 : 0.0;
    if (projCoords.z > 1.0)
        shadow = 0.0;
    return shadow;
}

void main()
{
    fc = iamb + (1.0 - ShadowCalculation(FragPosLightSpace)) * (idiff + ispec);
}
