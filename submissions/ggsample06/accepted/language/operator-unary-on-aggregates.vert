#version 410 core
// Unary + and - on scalars, vectors and matrices.
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main()
{
    mat4 opposite = -mw;
    vec3 v = normalize((+opposite * pv).xyz);             // minus the eye-space position
    vec3 l = -vec3(-0.0, -0.0, -1.0), n = -normalize((-mg * cv).xyz);
    float d = max(- -dot(n, l), +0.0), s = max(dot(-n, -normalize(l + v)), 0.0);
    vc = -(-vec4(0.12, 0, 0, 1) - d * vec4(.6, 0, 0, 0) - pow(s, 80.) * vec4(.4, .4, .4, 0));
    gl_Position = -(-mc) * +pv;
}
