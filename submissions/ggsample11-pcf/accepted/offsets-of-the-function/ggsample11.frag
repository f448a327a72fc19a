#version 410 core

// The light of the vertices, interpolated.

uniform sampler2DShadow depth;

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 ps;

layout (location = 0) out vec4 fc;

void main()
{
    vec3 q = ps.xyz / ps.w * 0.5 + 0.5;
    float s = 0.0;
    s += textureOffset(depth, q, ivec2(-1, -1));
    s += textureOffset(depth, q, ivec2(0, -1));
    s += textureOffset(depth, q, ivec2(1, -1));
    s += textureOffset(depth, q, ivec2(-1, 0));
    s += textureOffset(depth, q, ivec2(0, 0));
    s += textureOffset(depth, q, ivec2(1, 0));
    s += textureOffset(depth, q, ivec2(-1, 1));
    s += textureOffset(depth, q, ivec2(0, 1));
    s += textureOffset(depth, q, ivec2(1, 1));
    s = s / 9.0;
    fc = iamb + s * (idiff + ispec);
}
