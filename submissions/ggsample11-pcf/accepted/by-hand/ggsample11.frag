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
    vec2 t = 1.0 / textureSize(depth, 0);
    float lit = 0.0;
    for (int k = 0; k < 9; ++k) {
        vec2 at = q.xy + t * vec2(k % 3 - 1, k / 3 - 1);
        float nearest = texture(depth, at).r;
        lit += q.z <= nearest + 0.0005 ? 1.0 : 0.0;
    }
    fc = iamb + (idiff + ispec) * (lit / 9.0);
}
