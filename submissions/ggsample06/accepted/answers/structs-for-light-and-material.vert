#version 410 core

struct Light { vec4 position; vec4 ambient; vec4 diffuse; vec4 specular; };
struct Material { vec4 ambient; vec4 diffuse; vec4 specular; float shininess; };

const Light light = Light(
    vec4(0.0, 0.0, 1.0, 0.0),
    vec4(0.2, 0.2, 0.2, 1.0),
    vec4(1.0, 1.0, 1.0, 0.0),
    vec4(1.0, 1.0, 1.0, 0.0)
);

const Material material = Material(
    vec4(0.6, 0.0, 0.0, 1.0),
    vec4(0.6, 0.0, 0.0, 1.0),
    vec4(0.4, 0.4, 0.4, 1.0),
    80.0
);

in vec4 pv;
in vec4 cv;
out vec4 vc;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w);
    vec3 l = normalize((light.position * p.w - p * light.position.w).xyz);
    vec3 n = normalize((mg * cv).xyz);
    vec3 h = normalize(l + v);

    vec4 a = material.ambient * light.ambient;
    vec4 d = material.diffuse * light.diffuse * max(dot(n, l), 0.0);
    vec4 s = material.specular * light.specular * pow(max(dot(n, h), 0.0), material.shininess);

    vc = a + d + s;
    gl_Position = mc * pv;
}
