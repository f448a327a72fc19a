#version 330 core

struct Material { sampler2D diffuse; sampler2D specular; float shininess; };
struct Light { vec3 position; vec3 ambient; vec3 diffuse; vec3 specular; };

in vec3 FragPos;
in vec3 Normal;
in vec2 TexCoords;
out vec4 FragColor;

uniform vec3 viewPos;
uniform Material material;
uniform Light light;

void main()
{
    vec3 wood = texture(material.diffuse, TexCoords).rgb;
    vec3 n = normalize(Normal);
    vec3 l = normalize(light.position - FragPos);
    vec3 h = normalize(l + normalize(viewPos - FragPos));

    vec3 ambient = light.ambient * wood;
    vec3 diffuse = max(dot(n, l), 0.0) * light.diffuse * wood;
    vec3 varnish = pow(max(dot(n, h), 0.0), material.shininess) * light.specular * texture(material.specular, TexCoords).r;
    FragColor = vec4(ambient + diffuse + varnish, 1.0);
}
