#version 410 core
// An attribute that is read in part, and one more output that the fragment shader does not read.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
out vec3 eye_normal;
out float unread[2];
flat out int serial;
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    n = normalize(mat3(mg) * cv.xyz);
    eye_normal = n;
    unread[0] = n.x; unread[1] = n.y;
    serial = gl_VertexID;
    vc = kamb * lamb + max(dot(eye_normal, l), 0.0) * kdiff * ldiff
       + pow(max(dot(vec3(unread[0], unread[1], n.z), normalize(l + v)), 0.0), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
