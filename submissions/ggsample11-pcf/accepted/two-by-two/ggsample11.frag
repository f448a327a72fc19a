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
    vec3 q = ps.xyz / ps.w * 0.5 + 0.5;
    vec2 h = 0.5 / vec2(textureSize(depth, 0));
    float s = 0.25 * (texture(depth, vec3(q.xy + vec2(-h.x, -h.y), q.z)) + texture(depth, vec3(q.xy + vec2(h.x, -h.y), q.z))
        + texture(depth, vec3(q.xy + vec2(-h.x, h.y), q.z)) + texture(depth, vec3(q.xy + h, q.z)));
    fc = iamb + s * (idiff + ispec);
}
