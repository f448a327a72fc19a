#version 330 core
layout(origin_upper_left, pixel_center_integer) in vec4 gl_FragCoord;
uniform vec2 resolution;
out vec4 FragColor;
void main()
{
    vec2 at = gl_FragCoord.xy / (resolution - 1.0);
    float line = mod(gl_FragCoord.y, 12.0) < 6.0 ? 1.0 : 0.6;
    FragColor = vec4(at * line, 0.5 - 0.2 * dFdy(gl_FragCoord.y), 1.0);
}
