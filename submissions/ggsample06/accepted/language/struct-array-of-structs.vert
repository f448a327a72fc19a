#version 410 core
// An array of structs: constant, and local with a variable index.
struct Term { vec4 k, l; };
const Term terms[3] = Term[3](Term(vec4(.6, 0, 0, 1), vec4(.2, .2, .2, 1)),
                              Term(vec4(.6, 0, 0, 1), vec4(1, 1, 1, 0)),
                              Term(vec4(.4, .4, .4, 1), vec4(1, 1, 1, 0)));
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main()
{
    vec3 v = -normalize((mw * pv).xyz), l = vec3(0, 0, 1), n = normalize((mg * cv).xyz);
    float w[3];
    w[0] = 1.0; w[1] = max(dot(n, l), 0.); w[2] = pow(max(dot(n, normalize(l + v)), 0.), 80.);
    Term mine[3] = terms;
    for (int i = 0; i < 3; i++) mine[i].k *= w[i];
    vc = vec4(0);
    for (int i = 0; i < 3; i++) vc += mine[i].k * mine[2 - (2 - i)].l;
    gl_Position = mc * pv;
}
