#version 410 core

// The light of the vertices, interpolated.

uniform sampler2DShadow depth;

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in Shadow
{
    vec4 place;
} shadow;

layout (location = 0) out vec4 fc;

void main()
{
    vec4 c = shadow.place;
    fc = iamb + (idiff + ispec) * texture(depth, vec3(c.x / c.w + 1.0, c.y / c.w + 1.0, c.z / c.w + 1.0) / 2.0);
}
