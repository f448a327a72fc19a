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
    float angle = 6.2832 * fract(sin(dot(gl_FragCoord.xy, vec2(31.7, 57.3))) * 4391.7);
    mat2 turn = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
    float s = 0.0;
    for (int k = 0; k < 16; k++) {
        float r = sqrt((float(k) + 0.5) / 16.0) * 2.5 / 800.0;
        float a = 2.4 * float(k);
        s += texture(depth, vec3(q.xy + turn * vec2(r * cos(a), r * sin(a)), q.z));
    }
    s /= 16.0;
    fc = iamb + s * (idiff + ispec);
}
