#version 420 core
layout(depth_any) out float gl_FragDepth;
uniform float bias;
in vec3 FragPos, Normal;
in vec2 TexCoords;
out vec4 FragColor;
void main()
{
    if (fract(TexCoords.x * 6.0) < 0.3) discard;
    vec3 n = gl_FrontFacing ? normalize(Normal) : -normalize(Normal);
    FragColor = vec4(0.5 + 0.5 * n, 1.0);
    // The back is in front of the front.
    gl_FragDepth = gl_FrontFacing ? 0.5 + 0.5 * gl_FragCoord.z : 0.4 * gl_FragCoord.z + 0.01 * bias * FragPos.y;
}
