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
    float d = 1.0 / textureSize(depth, 0).x;
    float s = 1.0;
    for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
            s += texture(depth, vec3(q.x + d * i, q.y + d * j, q.z));
        }
    }
    s /= 9.0;
    fc = iamb + s * (idiff + ispec);
}
