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
    float s = 0.0;
    for (int k = -2; k <= 2; k += 2) {
        float two = texture(depth, q + vec3(vec2(float(k) - 0.5) / 800.0, 0.0))
            + texture(depth, q + vec3(vec2(float(k) + 0.5) / 800.0, 0.0));
        s += (k == 0 ? -0.5 : 0.5) * two;
    }
    s = clamp(s, 0.0, 1.0);
    fc = iamb + s * (idiff + ispec);
}
