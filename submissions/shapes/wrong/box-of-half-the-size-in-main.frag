#version 330 core
uniform vec3 iResolution;
uniform float iTime;
out vec4 pixel;

struct Hit { float dist; };

float polySmin(float a, float b, float k)
{
    float h = clamp(0.5 + (b - a) / (2.0 * k), 0.0, 1.0);
    return h * a + (1.0 - h) * b - k * h * (1.0 - h);
}

void main()
{
    vec2 centre = 0.5 * iResolution.xy;
    vec2 p = (gl_FragCoord.xy - centre) / centre.y;

    float s = sin(0.7 * iTime), c = cos(0.7 * iTime);
    vec2 turned = mat2(c, s, -s, c) * p;
    vec2 outside = abs(turned) - vec2(0.2, 0.45);
    float box;
    if (outside.x <= 0.0 && outside.y <= 0.0)
        box = max(outside.x, outside.y);
    else
        box = length(max(outside, 0.0));
    box -= 0.05;

    float disc = length(vec2(p.x - 0.5 * cos(iTime), p.y)) - 0.3;
    float d = polySmin(disc, box, 0.2);
    float hole = length(p) - 0.12;
    if (-hole > d) d = -hole;

    vec3 paper = vec3(0.95, 0.9, 0.8) * mix(0.7, 1.0, 0.5 + 0.5 * cos(60.0 * d));
    float t = clamp((d + 0.01) / 0.02, 0.0, 1.0);
    t = t * t * (3.0 - 2.0 * t);
    vec3 col = vec3(0.1, 0.25, 0.6) * (1.0 - t) + paper * t;
    float dd = d < 0.0 ? -d : d;
    pixel = vec4(col + vec3(1.0, 0.5, 0.1) * exp(-8.0 * dd), 1.0);
}
