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
    vec2 size = vec2(textureSize(depth, 0));
    vec4 four = textureGather(depth, q.xy, q.z);
    vec2 f = fract(q.xy * size - 0.5);
    float s = mix(mix(four.w, four.z, f.x), mix(four.x, four.y, f.x), f.y);
    fc = iamb + s * (idiff + ispec);
}
