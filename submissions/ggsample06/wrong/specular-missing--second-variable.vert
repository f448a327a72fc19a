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

void main()
{
    vec4 eye = mw * pv;
    vec3 v = normalize(-eye.xyz / eye.w);
    vec3 l = normalize(pl.xyz);
    vec3 n = normalize((mg * cv).xyz);
    vec3 h = normalize(l + v);
    vec4 shine = vec4(0.0);
    float nh = dot(n, h);
    if (nh > 0.0)
    {
        vec4 shine = pow(nh, kshi) * kspec * lspec;
    }
    vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + shine;
    gl_Position = mc * pv;
}
