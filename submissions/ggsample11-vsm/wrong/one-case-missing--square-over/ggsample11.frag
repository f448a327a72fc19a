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
    float t = (q.z - m.x) * (q.z - m.x) / (m.y - m.x * m.x + 1e-6);
    float s = 1.0 / (1.0 + t);
    fc = iamb + s * (idiff + ispec);
}
