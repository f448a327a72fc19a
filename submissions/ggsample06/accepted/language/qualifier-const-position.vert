#version 410 core
// const in other places of a declaration: after the layout, in parameters, with arrays.
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
const float e = 80.0, ten[] = float[](0.12, 0.6, 0.4);
float shade(const in float a[3], const vec3 w) { return a[0] * w.x + a[1] * w.y + a[2] * w.z; }
void main()
{
    const vec3 l = vec3(0, 0, 1);
    vec3 n = normalize((mg * cv).xyz), v = -normalize((mw * pv).xyz);
    vec3 w = vec3(1, max(dot(n, l), 0), pow(max(dot(n, normalize(l + v)), 0), e));
    vc = vec4(shade(ten, w), vec2(ten[2] * w.z), 1);
    gl_Position = mc * pv;
}
