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
    vec4 place = vec4(ps.xyz * 0.5 + 0.5 * ps.w, ps.w);
    vec2 m = textureProj(moments, place).rg;
    float t = place.z / place.w;
    float v = max(m.y - m.x * m.x, 1e-6), d = t - m.x;
    float s = t > m.x ? v / (v + d * d) : 1.0;
    fc = iamb + s * (idiff + ispec);
}
