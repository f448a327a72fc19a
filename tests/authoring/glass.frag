#version 450 core
layout(location = 0) in vec3 worldPos;
layout(location = 1) in vec3 worldNormal;
layout(location = 0) out vec4 color;
uniform samplerCube skybox;
uniform vec3 eye;
uniform float f0;
void main() {
    vec3 N = normalize(worldNormal);
    vec3 V = normalize(eye - worldPos);
    vec3 R = reflect(-V, N);
    float F = f0 + (1.0 - f0) * pow(1.0 - max(dot(N, V), 0.0), 5.0);
    vec3 reflection = texture(skybox, R).rgb * F;
    vec3 base = vec3(0.1, 0.15, 0.25) * (1.0 - F);
    color = vec4(reflection + base, 1.0);
}
