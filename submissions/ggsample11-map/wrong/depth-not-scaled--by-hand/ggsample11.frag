#version 410 core

// The light of the vertices, interpolated.

uniform sampler2D depth;

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 ps;

layout (location = 0) out vec4 fc;

void main()
{
    vec2 uv = (ps.xy / ps.w + 1.0) * 0.5;
    float s = ps.z / ps.w <= texture(depth, uv).r ? 1.0 : 0.0;
    fc = iamb + s * (idiff + ispec);
}
