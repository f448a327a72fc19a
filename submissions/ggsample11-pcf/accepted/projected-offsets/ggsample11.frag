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
    vec4 place = vec4(ps.xyz * 0.5 + ps.w * 0.5, ps.w);
    float s = 0.0;
    for (int y = -2; y <= 2; y += 2)
        for (int x = -2; x <= 2; x += 2)
            s += textureProj(depth, place + vec4(x, y, 0, 0) * ps.w / 800.0);
    s /= 9.0;
    fc = iamb + s * (idiff + ispec);
}
