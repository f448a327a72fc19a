#version 410 core

// The light of the vertices, interpolated.

uniform sampler2DShadow shadowMap;

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 shadowCoord;

layout (location = 0) out vec4 fc;

void main()
{
    float lit = textureProj(shadowMap, shadowCoord);
    fc = iamb + (idiff + ispec) * lit;
}
