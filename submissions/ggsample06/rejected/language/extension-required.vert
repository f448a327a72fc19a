#version 410 core
// An extension that nobody has, required.
#extension GL_NOBODY_has_this : require
in vec4 pv;
in vec4 cv;
uniform mat4 mw, mc, mg;
out vec4 vc;

// 光源と材質
struct Light { vec4 position, ambient, diffuse, specular; };
const Light light = Light(vec4(0, 0, 1, 0), vec4(0.2, 0.2, 0.2, 1), vec4(1, 1, 1, 0), vec4(1, 1, 1, 0));
const vec4 red = vec4(0.6, 0.0, 0.0, 1.0), white = vec4(0.4, 0.4, 0.4, 1.0);

float positive(float x)
{
    return x > 0.0 ? x : 0.0;
}

void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w);
    vec3 l = normalize((light.position * p.w - p * light.position.w).xyz);
    vec3 n = normalize((mg * cv).xyz);
    float weights[3];
    weights[0] = 1.0;
    weights[1] = positive(dot(n, l));
    weights[2] = pow(positive(dot(n, normalize(l + v))), 80.0);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 3; ++i) {
        switch (i) {
        case 0: sum += weights[i] * red * light.ambient; break;
        case 1: sum += weights[i] * red * light.diffuse; break;
        default: sum += weights[i] * white * light.specular;
        }
    }
    vc = sum;
    gl_Position = mc * pv;
}
