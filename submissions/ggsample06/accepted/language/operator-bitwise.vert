#version 410 core
// & | ^ ~ on int, uint and their vectors, with assignments.
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
    const int AMBIENT = 1, DIFFUSE = 2, SPECULAR = 4;
    int terms = 0;
    terms |= AMBIENT | SPECULAR;
    terms ^= DIFFUSE | 8;
    terms &= ~8;
    uvec3 mask = uvec3(0xFFu, 0x0Fu, 0xF0u) & 0x3Cu;     // 60, 12, 48
    uint same = (mask.y | mask.z) ^ mask.x;              // 0
    vec4 c = vec4(float(same));
    if ((terms & AMBIENT) != 0) c += kamb * lamb;
    if ((terms & DIFFUSE) == DIFFUSE) c += max(dot(n, l), 0.0) * kdiff * ldiff;
    if (bool(terms & SPECULAR)) c += pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
    if ((terms & 8) != 0) c = vec4(1.0);
    vc = c;
    gl_Position = mc * pv;
}
