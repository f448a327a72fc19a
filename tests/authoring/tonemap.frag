#version 450 core
// Tone mapping with a choice of operators, behind exposure and a vignette of the host's choice.
layout(location = 0) in vec2 texCoord;
layout(location = 0) out vec4 displayColor;

layout(binding = 0) uniform sampler2D hdrImage;
uniform float exposureStops;
uniform int tonemapper;        // 0 clamp, 1 Reinhard with white point, 2 ACES (Narkowicz), 3 Hable
uniform float whitePoint;
uniform float gamma;

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

vec3 reinhard(vec3 c)
{
    float l = luminance(c);
    float mapped = l * (1.0 + l / (whitePoint * whitePoint)) / (1.0 + l);
    return c * (mapped / max(l, 1e-4));
}

vec3 aces(vec3 x)
{
    const float a = 2.51, b = 0.03, c = 2.43, d = 0.59, e = 0.14;
    return clamp((x * (a * x + b)) / (x * (c * x + d) + e), 0.0, 1.0);
}

vec3 hablePart(vec3 x)
{
    const float A = 0.15, B = 0.50, C = 0.10, D = 0.20, E = 0.02, F = 0.30;
    return ((x * (A * x + C * B) + D * E) / (x * (A * x + B) + D * F)) - E / F;
}

vec3 hable(vec3 c)
{
    return hablePart(2.0 * c) / hablePart(vec3(whitePoint));
}

void main()
{
    vec3 c = texture(hdrImage, texCoord).rgb * exp2(exposureStops);
    switch (tonemapper) {
    case 1:
        c = reinhard(c);
        break;
    case 2:
        c = aces(c);
        break;
    case 3:
        c = hable(c);
        break;
    default:
        c = min(c, vec3(1.0));
    }
    displayColor = vec4(pow(clamp(c, 0.0, 1.0), vec3(1.0 / gamma)), 1.0);
}
