#version 410 core

// The light of the vertices, interpolated.

uniform sampler2D moments;

in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 ps;

layout (location = 0) out vec4 fc;

struct Moments { float mean; float square; };

Moments read(vec2 at)
{
    vec4 texel = texture(moments, at);
    return Moments(texel.r, texel.g);
}

void main()
{
    vec3 place = vec3(0.5) + 0.5 * ps.xyz / ps.w;
    Moments m = read(place.st);
    float variance = max(m.square - m.mean * m.mean, 0.0001);
    float beyond = max(0.0, place.p - m.mean);
    fc = iamb + (idiff + ispec) * (variance / (variance + beyond * beyond));
}
