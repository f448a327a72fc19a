// A tunnel.
float band(float x) { return 0.5 + 0.5 * sin(x); }

void mainImage( out vec4 fragColor, in vec2 fragCoord )
{
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    float a = atan(p.y, p.x);
    float r = length(p) + 0.05;
    vec3 col = vec3(band(10.0 / r + iTime), band(6.0 * a + 3.0 * iTime), 0.5);
    col *= smoothstep(0.0, 0.6, r);
    fragColor = vec4(col, 1.0);
}
