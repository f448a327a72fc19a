#version 410 core
// matrixCompMult and outerProduct.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float d = max(dot(n, l), 0.0), s = pow(max(dot(n, normalize(l + v)), 0.0), kshi);
    mat4 products = matrixCompMult(mat4(kamb, kdiff, kspec, vec4(0)), mat4(lamb, ldiff, lspec, vec4(1)));
    mat3x2 o = outerProduct(vec2(d, s), vec3(1.0, 2.0, 4.0));      // column i is (d, s) * factor i
    float dd = o[2].x / 4.0, ss = o[1][1] / 2.0;
    vc = products * vec4(1.0, dd, ss, 0.0);
    gl_Position = mc * pv;
}
