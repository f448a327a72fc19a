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
    for (float y = -1.5; y < 2.0; y += 1.0)
        for (float x = -1.5; x < 2.0; x += 1.0)
            s += texture(depth, q + vec3(vec2(x, y) / 800.0, 0.0));
    s *= 0.0625;
    fc = iamb + s * (idiff + ispec);
}
