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
    vec4 m = texture(moments, q.xy);
    float v = max(m.g - m.r * m.r, 1e-5);
    float d = q.z - m.r;
    float s = max(step(q.z, m.r), v / (v + d * d));
    fc = iamb + s * (idiff + ispec);
}
