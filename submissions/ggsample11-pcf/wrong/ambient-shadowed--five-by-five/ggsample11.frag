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
    float s = 0.0;
    for (int i = -2; i <= 2; ++i) {
        for (int j = -2; j <= 2; ++j) {
            s += texture(depth, vec3(q.x + d * i, q.y + d * j, q.z));
        }
    }
    s /= 25.0;
    fc = s * (iamb + idiff + ispec);
}
