const int CIRCLE = 0;
const int BOX = 1;
struct Shape { int kind; vec2 centre; vec2 size; float angle; };

mat2 rot(float a) { float s = sin(a), c = cos(a); return mat2(c, -s, s, c); }

float dist(Shape s, vec2 p)
{
    p -= s.centre;
    p = p * rot(s.angle);
    if (s.kind == CIRCLE)
        return length(p) - s.size.x;
    vec2 q = abs(p) - s.size;
    return length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - 0.05;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    float aspect = iResolution.x / iResolution.y;
    vec2 p = (fragCoord / iResolution.xy - 0.5) * vec2(2.0 * aspect, 2.0);
    Shape all[2];
    all[0] = Shape(CIRCLE, vec2(0.5 * cos(iTime), 0.0), vec2(0.3), 0.0);
    all[1] = Shape(BOX, vec2(0.0), vec2(0.45, 0.2), 0.7 * iTime);
    float d[2];
    for (int i = 0; i < 2; i++)
        d[i] = dist(all[i], p);
    float h = clamp(0.5 + 2.5 * (d[1] - d[0]), 0.0, 1.0);
    float u = mix(d[1], d[0], h) - 0.2 * h * (1.0 - h);
    float m = max(u, 0.12 - length(p));

    vec3 col = vec3(0.95, 0.9, 0.8) * (0.85 + 0.15 * cos(m * 60.0));
    float inside = 1.0 - smoothstep(-0.01, 0.01, m);
    col = mix(col, vec3(0.1, 0.25, 0.6), inside);
    col += exp(-8.0 * abs(m)) * vec3(1.0, 0.5, 0.1);
    fragColor = vec4(col, 1.0);
}
