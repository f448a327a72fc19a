#version 410 core

// A right answer to ggsample11, the way of the shadow map: what the light does not reach has the ambient light alone. What
// assignment.toml replaces stands here once.

uniform sampler2DShadow depth;  // the depths that the light sees

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 ps;

layout (location = 0) out vec4 fc;

void main()
{
    vec3 ndc = ps.xyz / ps.w;
    vec3 q = ndc * 0.5 + 0.5;
    float lit = texture(depth, q);
    fc = iamb + (idiff + ispec) * lit;
}
