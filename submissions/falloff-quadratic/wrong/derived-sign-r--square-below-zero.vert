#version 410 core
const vec4 pl = vec4(0.3, 0.9, -3.4, 1.0);
const vec4 lamb = vec4(0.25, 0.25, 0.3, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 0.95, 0.7, 0.0);
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.75, 0.12, 0.08, 1.0);
const vec4 kspec = vec4(0.4, 0.42, 0.45, 1.0);
const float kshi = 40.0;
const float sc = 0.2;
const float sl = 0.15;
const float sq = 0.1;
layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

void lightAt(in vec4 p, out vec3 direction, out float strength)
{
    vec3 q = pl.xyz * p.w - p.xyz * pl.w;
    q /= pl.w * p.w;
    float r = sqrt(q.x * q.x + q.y * q.y + q.z * -q.z);
    direction = q / r;
    strength = 1.0 / (sc + sl * r + sq * r * r);
}

void main()
{
    vec4 p = mw * pv;
    vec3 l, v = normalize(-p.xyz);
    float strength;
    lightAt(p, l, strength);
    vec3 n = normalize(mat3(mg) * cv.xyz);
    vec4 diffuse = vec4(0.0), specular = vec4(0.0);
    float nl = dot(n, l);
    if (nl > 0.0) diffuse = nl * kdiff * ldiff;
    float nh = dot(n, normalize(l + v));
    if (nh > 0.0) specular = pow(nh, kshi) * kspec * lspec;
    vc = strength * diffuse + strength * specular + kamb * lamb;
    gl_Position = mc * pv;
}
