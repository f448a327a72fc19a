#version 410 core

// The light: its position (w = 0: parallel rays), and what it sends out.
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);

// The surface: what it sends back of that.
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;

layout (location = 0) in vec4 pv;
in vec4 cv;

uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

out vec4 vc;

vec4 shade(vec3 n, vec3 l, vec3 h)
{
    float d = dot(n, l);
    float s = dot(n, h);
    if (d <= 0.0 && s <= 0.0);
        return kamb * lamb;
    return kamb * lamb + max(d, 0.0) * kdiff * ldiff + pow(max(s, 0.0), kshi) * kspec * lspec;
}

void main()
{
    vec4 eye = mw * pv;
    vec3 v = normalize(-eye.xyz / eye.w);
    vec3 l = normalize(pl.xyz);
    vc = shade(normalize((mg * cv).xyz), l, normalize(l + v));
    gl_Position = mc * pv;
}
