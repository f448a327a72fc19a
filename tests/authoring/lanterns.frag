#version 330 core
struct Light {
    vec3 position;
    float intensity;
    vec3 color;
    float radius;
};

layout(std140) uniform Lights {
    Light lights[3];
    int lightCount;
};

uniform vec3 albedo;
uniform vec3 ambient;
uniform float exposure;

in vec3 worldPos;
in vec3 worldNormal;
out vec4 outColor;

vec3 shade(Light light, vec3 n)
{
    vec3 toLight = light.position - worldPos;
    float d = length(toLight);
    float falloff = clamp(1.0 - d / light.radius, 0.0, 1.0);
    return light.color * light.intensity * falloff * falloff * max(dot(n, toLight / d), 0.0);
}

vec3 aces(vec3 x)
{
    return clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

void main()
{
    vec3 n = normalize(worldNormal);
    vec3 sum = ambient * albedo;
    for (int i = 0; i < lightCount; i++)
        sum += albedo * shade(lights[i], n);
    vec3 mapped = aces(sum * exposure);
    outColor = vec4(pow(mapped, vec3(1.0 / 2.2)), 1.0);
}
