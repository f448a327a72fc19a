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
    vec3 q = ps.xyz / ps.w * 0.5 + 0.5;
    ivec2 size = textureSize(depth, 0);
    ivec2 at = clamp(ivec2(floor(q.xy * vec2(size))), ivec2(0), size - 1);
    float lit = step(q.z, texelFetch(depth, at, 0).x);
    fc = mix(iamb, iamb + idiff + ispec, lit);
}
