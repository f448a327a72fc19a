#version 410 core

// The light of the vertices, interpolated.

uniform sampler2DShadow depth;

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 ps;

layout (location = 0) out vec4 fc;

const vec2 disc[8] = vec2[](vec2(-0.61, 0.15), vec2(0.35, 0.72), vec2(0.83, -0.12), vec2(-0.17, -0.88),
    vec2(0.12, 0.05), vec2(-0.42, 0.79), vec2(0.51, -0.63), vec2(-0.79, -0.47));

void main()
{
    vec3 q = ps.xyz / ps.w * 0.5 + 0.5;
    float s = 0.0;
    for (int k = 0; k < 8; k++)
        s += texture(depth, vec3(q.xy + disc[k] / 400.0, q.z)) / 8.0;
    fc = iamb + s * (idiff + ispec);
}
