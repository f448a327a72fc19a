#version 410 core

// A right answer to ggsample11 with soft edges: how many of nine comparisons around a place the light passes is its share. What
// assignment.toml replaces stands here once.

uniform sampler2DShadow depth;  // the depths that the light sees

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 ps;

layout (location = 0) out vec4 fc;

float share(vec3 place)
{
    vec2 texel = 1.0 / vec2(textureSize(depth, 0));
    float sum = 0.0;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++)
            sum += texture(depth, place + vec3(vec2(x, y) * texel, 0.0));
    return sum / 9.0;
}

void main()
{
    vec3 ndc = ps.xyz / ps.w;
    vec3 q = ndc * 0.5 + 0.5;
    float lit = share(q);
    fc = iamb + (idiff + ispec) * lit;
}
