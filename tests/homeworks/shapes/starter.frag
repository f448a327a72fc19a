#version 330 core
uniform vec3 iResolution;
uniform float iTime;
out vec4 pixel;

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
    // Write your code here.
    fragColor = vec4(0.5, 0.5, 0.5, 1.0);
}

void main() { mainImage(pixel, gl_FragCoord.xy); }
