#version 410 core
// vec4 put together from scalars, vectors, integers and booleans in every order.
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main()
{
    vec4 p = vec4(mw * pv);
    vec3 n = normalize(vec3(mg * vec4(cv.xy, cv.z, 1)));
    vec2 zero = vec2(false);
    vec4 kd = vec4(0.6, zero, true), ka = vec4(vec2(0.6, 0), vec2(zero.y, 1u)), ks = vec4(vec3(.4), 1);
    vec3 l = vec3(zero, 1), v = normalize(-vec3(p.x, p.yz)), h = normalize(vec3(l.xy + v.xy, l.z + v.z));
    vc = ka * vec4(0.2, vec3(0.2, 0.2, 1.0)) + vec4(max(dot(n, l), 0)) * kd
       + vec4(vec2(pow(max(dot(n, h), 0), 80)), vec2(pow(max(dot(n, h), 0), 80), 0)) * ks;
    gl_Position = mc * vec4(pv.xyz, pv.w);
}
