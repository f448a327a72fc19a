#version 410 core
in vec4 pv;
in vec4 cv;
out vec4 vc;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

struct Material {
    vec4 amb;
    vec4 diff;
    vec4 spec;
    float shi;
}

const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);

void main()
{
    Material m = Material(vec4(0.6, 0.0, 0.0, 1.0), vec4(0.6, 0.0, 0.0, 1.0), vec4(0.4, 0.4, 0.4, 1.0), 80.0);
    vec3 v = -normalize((mw * pv).xyz);
    vec3 l = pl.xyz;
    vec3 n = normalize((mg * cv).xyz);
    vec3 h = normalize(l + v);
    vc = m.amb * lamb + m.diff * max(dot(n, l), 0.0) + m.spec * pow(max(dot(n, h), 0.0), m.shi);
    gl_Position = mc * pv;
}
