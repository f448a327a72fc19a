float shapes(vec2 p)
{
    float best = 1e9;
    float c = length(p - 0.5 * vec2(cos(iTime), 0.0)) - 0.3;
    // turn the coordinates against the clock
    float ang = 0.7 * iTime;
    vec2 xAxis = vec2(cos(ang), -sin(ang));
    vec2 yAxis = vec2(sin(ang), cos(ang));
    vec2 q = vec2(dot(xAxis, p), dot(yAxis, p));
    vec2 d = abs(q) - vec2(0.45, 0.2);
    float b = length(max(d, 0.0)) + min(max(d.x, d.y), 0.0) - 0.05;
    float h = clamp(0.5 + 0.5 * (b - c) / 0.2, 0.0, 1.0);
    best = min(best, mix(b, c, h) - 0.2 * h * (1.0 - h));
    return max(best, -(length(p) - 0.12));
}

vec3 shade(float d)
{
    vec3 color = vec3(0.95, 0.9, 0.8);
    color -= color * 0.15 * (1.0 - cos(60.0 * d));
    vec3 ink = vec3(0.1, 0.25, 0.6);
    if (d <= -0.01) color = ink;
    else if (d < 0.01) color = mix(ink, color, smoothstep(-0.01, 0.01, d));
    return color;
}

void mainImage(out vec4 O, vec2 U)
{
    vec2 R = iResolution.xy;
    float d = shapes((U + U - R) / R.y);
    O.rgb = shade(d) + vec3(1.0, 0.5, 0.1) / exp(8.0 * abs(d));
    O.a = 1.0;
}
