#version 410 core

// A right answer to ggsample11 with variance shadow maps: mean and variance of the depths around a place bound the share of them that
// lies behind it. What assignment.toml replaces stands here once.

uniform sampler2D moments;  // the mean of the depths that the light sees, and that of their squares

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 ps;

layout (location = 0) out vec4 fc;

float share(vec3 place)
{
    vec2 m = texture(moments, place.xy).rg;
    float variance = max(m.y - m.x * m.x, 1e-6);
    float d = place.z - m.x;
    float bound = variance / (variance + d * d);
    return d > 0.0 ? bound : 1.0;
}

void main()
{
    vec3 ndc = ps.xyz / ps.w;
    vec3 q = ndc * 0.5 + 0.5;
    float lit = share(q);
    fc = iamb + (idiff + ispec) * lit;
}
