#version 410 core
layout(std140) uniform Beam { vec4 position; vec3 color; bool on; mat3x2 bend; } beams[2];
in vec3 FragPos, Normal;
in vec2 TexCoords;
out vec4 FragColor;
void main()
{
    vec3 sum = vec3(0.1);
    for (int i = 0; i < beams.length(); i++) {
        vec3 l = normalize(beams[i].position.xyz - FragPos);
        if (beams[i].on) sum += beams[i].color * max(dot(normalize(Normal), l), 0.0);
        sum.rg += 0.1 * abs(beams[i].bend * vec3(TexCoords, 1.0));
    }
    FragColor = vec4(sum, 1.0);
}
