#version 410 core

// The light of the vertices, interpolated.

uniform sampler2D moments;

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 ps;

layout (location = 0) out vec4 fc;

void main()
{
    vec3 q = ps.xyz / ps.w * 0.5 + 0.5;
    vec2 m = texture(moments, q.xy).rg;
    fc = iamb;
    float excess = q.z - m.r;
    if (excess > 0.0) {
        float variance = m.g - m.r * m.r;
        if (variance < 1e-6) variance = 1e-6;
        fc += (idiff + ispec) * variance / (variance + excess * excess);
    } else {
        fc += idiff + ispec;
    }
}
