#define PAPER vec3(0.95, 0.9, 0.8)
#define INK vec3(0.1, 0.25, 0.6)
#define GLOW vec3(1.0, 0.5, 0.1)

float sdCircle(vec2 p, vec2 c, float r) { return distance(p, c) - r; }

float sdRoundBox(vec2 p, vec2 half_, float r)
{
    vec2 q = abs(p) - half_;
    return min(max(q.x, q.y), 0.0) + length(max(q, vec2(0.0))) - r;
}

float smoothUnion(float a, float b, float k)
{
    float h = max(k - abs(a - b), 0.0) / k;
    return min(a, b) - h * h * k * 0.25;
}

float scene(vec2 p)
{
    float a = 0.7 * iTime;
    vec2 q = vec2(p.x * cos(a) - p.y * sin(a), p.x * sin(a) + p.y * cos(a));
    float d = smoothUnion(sdCircle(p, vec2(0.5 * cos(iTime), 0.0), 0.3), sdRoundBox(q, vec2(0.45, 0.2), 0.05), 0.2);
    return max(d, 0.12 - length(p));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 uv = fragCoord / iResolution.xy * 2.0 - 1.0;
    uv.x *= iResolution.x / iResolution.y;
    float d = scene(uv);
    vec3 col = PAPER * (0.85 + 0.15 * cos(60.0 * d));
    col = mix(INK, col, smoothstep(-0.01, 0.01, d));
    col += GLOW * exp(-8.0 * abs(d));
    fragColor = vec4(col, 1.0);
}
