#version 410 core
// A struct made by its constructor, at global and local scope.
struct Light { vec4 position, ambient, diffuse, specular; };
struct Material { vec4 ambient, diffuse, specular; float shininess; };
const Light light = Light(vec4(0, 0, 1, 0), vec4(.2, .2, .2, 1), vec4(1, 1, 1, 0), vec4(1, 1, 1, 0));
const Material red = Material(vec4(.6, 0, 0, 1), vec4(.6, 0, 0, 1), vec4(.4, .4, .4, 1), 80.);
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), n = normalize((mg * cv).xyz);
    vec3 l = normalize((light.position * p.w - p * light.position.w).xyz), h = normalize(l + v);
    struct Factors { float diffuse, specular; } f;
    f = Factors(max(dot(n, l), 0.), pow(max(dot(n, h), 0.), red.shininess));
    vc = red.ambient * light.ambient + f.diffuse * red.diffuse * light.diffuse + f.specular * red.specular * light.specular;
    gl_Position = mc * pv;
}
