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
    vec2 t = 1.0 / vec2(textureSize(depth, 0));
    float s = 0.0;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++)
            s += float((2 - abs(x)) * (2 - abs(y))) * texture(depth, q + vec3(t * vec2(x, y), 0.0));
    s /= 16.0;
    fc = iamb + s * (idiff + ispec);
}
