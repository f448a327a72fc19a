// complex numbers for the rotation
vec2 cmul(vec2 a, vec2 b) { return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x); }
vec2 cexp(float t) { return vec2(cos(t), sin(t)); }

void mainImage(out vec4 o, in vec2 c)
{
    vec2 p = (c - 0.5 * iResolution.xy) / (0.5 * iResolution.y);
    vec2 q = abs(cmul(cexp(0.7 * iTime), p)) - vec2(0.45, 0.2);
    float b = length(vec2(max(q.x, 0.0), max(q.y, 0.0))) + (max(q.x, q.y) < 0.0 ? max(q.x, q.y) : 0.0) - 0.05;
    p.x -= 0.5 * cos(iTime);
    float a = sqrt(dot(p, p)) - 0.3;
    p.x += 0.5 * cos(iTime);
    float d;
    if (a - b >= 0.2) d = b;
    else if (b - a >= 0.2) d = a;
    else {
        float h = 0.5 + 2.5 * (b - a);
        d = b + (a - b) * h - 0.2 * (h - h * h);
    }
    d = max(d, 0.12 - length(p));
    float w = d >= 0.01 ? 0.0 : d <= -0.01 ? 1.0 : 1.0 - smoothstep(-0.01, 0.01, d);
    vec3 stripes = vec3(0.95, 0.9, 0.8) * (1.0 - 0.3 * sin(30.0 * d) * sin(30.0 * d));
    o = vec4(mix(stripes, vec3(0.1, 0.25, 0.6), w) + vec3(1.0, 0.5, 0.1) * exp(-8.0 * abs(d)), 1.0);
}
