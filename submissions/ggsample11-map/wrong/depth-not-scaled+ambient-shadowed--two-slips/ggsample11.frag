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
    vec3 q = ps.xyz / ps.w;
    q.xy = q.xy * 0.5 + 0.5;
    fc = (iamb + idiff + ispec) * texture(depth, q);
}
