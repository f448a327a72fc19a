#version 330 core
#define LAMPS 3

struct Sun { vec3 direction; vec3 color; };
struct Lamp { vec3 position; vec3 color; float linear; float quadratic; };
struct Torch { vec3 position; vec3 direction; float cutOff; float outerCutOff; vec3 color; };

in vec3 FragPos;
in vec3 Normal;
out vec4 FragColor;

uniform vec3 viewPos;
uniform Sun sun;
uniform Lamp lamps[LAMPS];
uniform Torch torch;
uniform vec3 objectColor;
uniform float shininess;

vec3 shade(vec3 n, vec3 l, vec3 v, vec3 color)
{
    float glance = pow(max(dot(n, normalize(l + v)), 0.0), shininess);
    return color * (max(dot(n, l), 0.0) * objectColor + 0.3 * glance);
}

vec3 fromSun(vec3 n, vec3 v)
{
    return 0.5 * shade(n, normalize(-sun.direction), v, sun.color);
}

vec3 fromLamp(Lamp lamp, vec3 n, vec3 v)
{
    float d = distance(lamp.position, FragPos);
    float fade = 1.0 / (1.0 + lamp.linear * d + lamp.quadratic * d * d);
    return 0.2 * fade * shade(n, (lamp.position - FragPos) / d, v, lamp.color);
}

vec3 fromTorch(vec3 n, vec3 v)
{
    vec3 l = normalize(torch.position - FragPos);
    float inside = dot(l, normalize(-torch.direction));
    float spot = clamp((inside - torch.outerCutOff) / (torch.cutOff - torch.outerCutOff), 0.0, 1.0);
    return spot * shade(n, l, v, torch.color);
}

void main()
{
    vec3 n = normalize(Normal);
    vec3 v = normalize(viewPos - FragPos);
    vec3 sum = fromSun(n, v);
    for (int i = 0; i < LAMPS; i++)
        sum += fromLamp(lamps[i], n, v);
    sum += fromTorch(n, v);
    FragColor = vec4(sum, 1.0);
}
