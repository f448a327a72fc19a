#version 410 core
// Members, parameters, labels of swizzles and functions with the same names: x, rgb, length, position, color.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
struct position { vec3 xyz, rgb; float length, w; };
float x(position position) { return max(dot(position.xyz, position.rgb), 0.0) * position.length; }
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    position a = position(n, l, 1.0, 5.0), xy = position(n, normalize(l + v), 1.0, a.xyz.xyz.x);
    float rgb = x(a), xyz = pow(x(xy), kshi);
    vc = kamb * lamb + rgb * kdiff * ldiff + xyz * kspec * lspec + (xy.w - a.xyz.r);
    gl_Position = mc * pv;
}
