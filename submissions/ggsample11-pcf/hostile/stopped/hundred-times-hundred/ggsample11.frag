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
    for (int y = -500; y < 500; y++)
        for (int x = -500; x < 500; x++)
            s += texture(depth, q + vec3(vec2(x, y) / 800.0, 0.0));
    s /= 1000000.0;
    fc = iamb + s * (idiff + ispec);
}
