// Shapes from distances
const vec3 PAPER = vec3(0.95, 0.9, 0.8);
const vec3 INK = vec3(0.1, 0.25, 0.6);
const vec3 GLOW = vec3(1.0, 0.5, 0.1);

float circle(vec2 p, float r)
{
    return length(p) - r;
}

float box(vec2 p, vec2 b)
{
    vec2 d = abs(p) - b;
    return length(max(d, 0.0)) + min(max(d.x, d.y), 0.0);
}

float smin(float a, float b, float k)
{
    float h = clamp(0.5 + 0.5 * (b - a) / k, 0.0, 1.0);
    return mix(b, a, h) - k * h * (1.0 - h);
}

mat2 rotation(float a)
{
    return mat2(cos(a), sin(a), -sin(a), cos(a));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;

    float c = circle(p - vec2(0.5 * cos(iTime), 0.0), 0.3);
    float b = box(p, vec2(0.45, 0.2)) - 0.05;
    float d = smin(c, b, 0.2);
    float hole = circle(p, 0.12);
    d = max(d, -hole);

    vec3 color = PAPER;
    color *= 0.85 + 0.15 * cos(60.0 * d);
    color = mix(INK, color, smoothstep(-0.01, 0.01, d));
    color += GLOW * exp(-8.0 * abs(d));
    fragColor = vec4(color, 1.0);
}
