#version 410 core
uniform vec3 cameraPosition;
uniform vec3 fogColor;
uniform float fogDensity;
uniform vec3 lightDirection;
uniform vec3 albedo;
in vec3 vWorldPosition;
in vec3 vNormal;
layout(location = 0) out vec4 fragColor;
void main() {
    vec3 n = normalize(vNormal);
    float lambert = max(dot(n, normalize(lightDirection)), 0.0);
    vec3 lit = albedo * (0.2 + 0.8 * lambert);
    float d = distance(cameraPosition, vWorldPosition);
    float f = exp(-pow(fogDensity * d, 2.0));
    vec3 c = mix(fogColor, lit, clamp(f, 0.0, 1.0));
    fragColor = vec4(c, 1.0);
}
