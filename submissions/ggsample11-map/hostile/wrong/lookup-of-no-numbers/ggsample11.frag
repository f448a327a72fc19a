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
    float zero = iamb.x - iamb.x;
    vec3 q = vec3(zero / zero, 1.0 / zero, -1.0 / zero);
    fc = iamb + (idiff + ispec) * texture(depth, q);
}
