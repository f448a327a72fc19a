#version 410 core
// lessThan, lessThanEqual, greaterThan, greaterThanEqual, equal, notEqual, any, all, not, on all kinds of vectors.
const float kshi=80.0;
const vec4 kspec=vec4(0.4,0.4,0.4,1.0);
const vec4 kdiff=vec4(0.6,0.0,0.0,1.0);
const vec4 kamb=vec4(0.6,0.0,0.0,1.0);
const vec4 lspec=vec4(1.0,1.0,1.0,0.0);
const vec4 ldiff=vec4(1.0,1.0,1.0,0.0);
const vec4 lamb=vec4(0.2,0.2,0.2,1.0);
const vec4 pl=vec4(0.0,0.0,1.0,0.0);
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    vec2 x = vec2(dot(n, l), dot(n, normalize(l + v)));
    x *= vec2(greaterThan(x, vec2(0)));
    bool fine = all(lessThan(ivec2(1, 2), ivec2(2, 3))) && !any(lessThanEqual(uvec2(4u, 5u), uvec2(3u)))
             && all(greaterThanEqual(vec3(2), vec3(2, 1, 0))) && any(equal(ivec3(1, 2, 3), ivec3(3, 2, 2)))
             && all(notEqual(bvec2(true, false), bvec2(false, true))) && all(not(equal(vec2(1, 2), vec2(2, 1))));
    vc = (fine ? kamb * lamb : vec4(1)) + x.x * kdiff * ldiff + pow(x.y, kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
