#version 410 core
uniform sampler2D shadowMap;
in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 FragPosLightSpace;
layout (location = 0) out vec4 fc;
float chebyshevUpperBound(vec2 uv, float distance)
{
    vec2 moments = texture(shadowMap, uv).rg;
    if (distance <= moments.x)
        return 1.0;
    float variance = moments.y - (moments.x * moments.x);
    variance = max(variance, 0.00001);
    float d = distance - moments.y;
    float p_max = variance / (variance + d * d);
    return p_max;
}
void main()
{
    vec3 proj = FragPosLightSpace.xyz / FragPosLightSpace.w;
    proj = proj * 0.5 + 0.5;
    float lit = chebyshevUpperBound(proj.xy, proj.z);
    fc = iamb + lit * (idiff + ispec);
}
