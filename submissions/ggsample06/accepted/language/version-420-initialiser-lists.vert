#version 420 core
// 4.20: { } initialises vectors, matrices, arrays and structs.
struct Term { vec4 k, l; float w; };
const Term ambient = { { 0.6, 0.0, 0.0, 1.0 }, vec4(0.2, 0.2, 0.2, 1.0), 1.0 };
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main()
{
    vec3 n = normalize((mg * cv).xyz), v = -normalize((mw * pv).xyz), l = { 0.0, 0.0, 1.0 };
    mat2 weights = { { 0.6, 0.0 }, { 0.4, 0.4 } };
    float ds[] = { max(dot(n, l), 0.0), pow(max(dot(n, normalize(l + v)), 0.0), 80.0), };
    vec2 rg = weights * vec2(ds[0], ds[1]);
    vc = ambient.k * ambient.l * ambient.w + vec4(rg, rg.y, 0.0);
    gl_Position = mc * pv;
}
