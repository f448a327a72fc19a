#version 420 core
// Workshop lighting: four lamps from a uniform block, wrapped diffuse and strands of brushed metal.
struct Lamp {
    vec4 place;        // xyz in world space, w = reach in metres
    vec3 colour;
    float wrap;        // 0: hard terminator, 1: light all around
    bool isOn;
};

layout(std140, binding = 2) uniform Workshop {
    Lamp lamps[4];
    vec3 skyColour;
    vec3 floorColour;
    int lampCount;
};

layout(std140) uniform Surface {
    vec3 tintColour;
    float gloss;
    float brushing;    // strength of the strand highlight
} surface;

uniform vec3 eyePosition;

in vec3 worldPos;
in vec3 worldNormal;
in vec3 worldTangent;

out vec4 result;

float reachOf(Lamp lamp, float d)
{
    float x = d / lamp.place.w;
    float x4 = x * x * x * x;
    float window = clamp(1.0 - x4, 0.0, 1.0);
    return window * window / (1.0 + d * d);
}

vec3 oneLamp(Lamp lamp, vec3 n, vec3 t, vec3 v)
{
    vec3 way = lamp.place.xyz - worldPos;
    float d = length(way);
    vec3 l = way / d;
    float wrapped = max((dot(n, l) + lamp.wrap) / (1.0 + lamp.wrap), 0.0);
    vec3 h = normalize(l + v);
    float th = dot(t, h);
    float strand = pow(sqrt(max(1.0 - th * th, 0.0)), surface.gloss);
    vec3 sum = surface.tintColour * wrapped;
    if (wrapped > 0.0)
        sum += surface.brushing * strand * wrapped;
    return lamp.colour * reachOf(lamp, d) * sum;
}

void main()
{
    vec3 n = normalize(worldNormal);
    vec3 t = normalize(worldTangent - n * dot(worldTangent, n));
    vec3 v = normalize(eyePosition - worldPos);

    vec3 light = surface.tintColour * mix(floorColour, skyColour, 0.5 + 0.5 * n.y);
    for (int i = 0; i < lampCount; ++i) {
        if (!lamps[i].isOn)
            continue;
        light += oneLamp(lamps[i], n, t, v);
    }
    result = vec4(light, 1.0);
}
