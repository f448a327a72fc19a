#version 410 core
// Object-like macros, macros in macros, #undef and a new definition.
#define EPS 0.0
#define RED vec4(0.6, 0.0, 0.0, 1.0)
#define KAMB RED
#define KDIFF RED
#define SHININESS (4 * TWENTY)
#define TWENTY 20.0
#define FACTOR 5.0
#undef FACTOR
#define FACTOR 1.0
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main()
{
    vec3 v = -normalize((mw * pv).xyz), l = vec3(0, 0, 1), n = normalize((mg * cv).xyz);
    vc = KAMB * vec4(.2, .2, .2, 1) + FACTOR * max(dot(n, l), EPS) * KDIFF + pow(max(dot(n, normalize(l + v)), EPS), SHININESS) * .4;
    gl_Position = mc * pv;
}
