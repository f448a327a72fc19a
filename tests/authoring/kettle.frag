#version 330 core
in vec3 FragPos;
in vec3 Normal;
in vec2 TexCoords;
out vec4 FragColor;

struct Material {
    sampler2D albedoMap;
    sampler2D roughnessMap;
    sampler2D metalnessMap;
};

uniform Material material;
uniform vec3 lightPos;
uniform vec3 lightColor;
uniform vec3 viewPos;

const float PI = 3.14159265359;

float distributionGGX(float nh, float roughness)
{
    float a = roughness * roughness;
    float a2 = a * a;
    float d = nh * nh * (a2 - 1.0) + 1.0;
    return a2 / (PI * d * d);
}

float geometrySchlick(float c, float roughness)
{
    float k = (roughness + 1.0) * (roughness + 1.0) / 8.0;
    return c / (c * (1.0 - k) + k);
}

vec3 fresnelSchlick(float c, vec3 f0)
{
    return f0 + (1.0 - f0) * pow(1.0 - c, 5.0);
}

void main()
{
    vec3 albedo = texture(material.albedoMap, TexCoords).rgb;
    float roughness = clamp(texture(material.roughnessMap, TexCoords).r, 0.2, 1.0);
    float metalness = texture(material.metalnessMap, TexCoords).r;

    vec3 n = normalize(Normal);
    vec3 v = normalize(viewPos - FragPos);
    vec3 l = normalize(lightPos - FragPos);
    vec3 h = normalize(l + v);
    float nl = max(dot(n, l), 0.0);
    float nv = max(dot(n, v), 0.001);
    float nh = max(dot(n, h), 0.0);
    float hv = max(dot(h, v), 0.0);

    vec3 f0 = mix(vec3(0.04), albedo, metalness);
    vec3 f = fresnelSchlick(hv, f0);
    float g = geometrySchlick(nl, roughness) * geometrySchlick(nv, roughness);
    vec3 specular = distributionGGX(nh, roughness) * g * f / (4.0 * nv * nl + 0.0001);
    vec3 diffuse = (1.0 - f) * (1.0 - metalness) * albedo / PI;
    vec3 ambient = 0.03 * albedo;
    FragColor = vec4(ambient + (diffuse + specular) * lightColor * nl, 1.0);
}
