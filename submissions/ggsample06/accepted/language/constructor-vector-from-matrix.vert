#version 410 core
// vec4(mat2) takes the components of the matrix in column order.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main(void)
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    mat2 m = mat2(max(dot(n, l), 0.0), 0.25, 0.5, 1.0);
    vec4 flat_out = vec4(m);                                 // d, .25, .5, 1
    vec2 start = vec2(m);                                    // d, .25
    float unit = flat_out.y * flat_out.z * 8.0 * flat_out.w;
    float s = pow(max(dot(n, normalize(l + v)), 0.0), kshi * start.y * 4.0);
    vc = kamb * lamb * unit + flat_out.x * kdiff * ldiff + s * kspec * lspec;
    gl_Position = mc * pv;
}
