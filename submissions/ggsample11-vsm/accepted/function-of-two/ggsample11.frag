#version 410 core

// The light of the vertices, interpolated.

uniform sampler2D vsm;

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 ps;

layout (location = 0) out vec4 fc;

float chebyshev(vec2 moments, float t)
{
    if (t <= moments.x)
        return 1.0;
    float variance = max(moments.y - moments.x * moments.x, 0.00002);
    float distance = t - moments.x;
    return variance / (variance + distance * distance);
}

void main()
{
    vec3 c = (ps.xyz / ps.w + 1.0) / 2.0;
    fc = iamb + chebyshev(texture(vsm, c.xy).xy, c.z) * (idiff + ispec);
}
