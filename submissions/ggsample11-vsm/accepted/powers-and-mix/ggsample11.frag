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
    vec2 m = texture(moments, q.xy).xy;
    float sigma2 = max(abs(m.y - pow(m.x, 2.0)), 1e-6);
    float p = sigma2 / (sigma2 + pow(q.z - m.x, 2.0));
    float s = mix(p, 1.0, float(q.z <= m.x));
    fc = iamb + s * (idiff + ispec);
}
