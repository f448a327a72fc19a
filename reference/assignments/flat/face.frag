#version 410 core

// Right as well: flat shading by the normal of the face, as the derivatives of the point give it; light is computed at each pixel.

// The light: its position (w = 0: parallel rays), and what it sends out.
const vec4 pl = vec4(2.0, 1.5, 1.0, 0.0);
const vec4 lamb = vec4(0.3, 0.3, 0.35, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 0.9, 0.0);

// The surface: what it sends back of that.
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.7, 0.15, 0.1, 1.0);
const vec4 kspec = vec4(0.4, 0.35, 0.3, 1.0);
const float kshi = 24.0;

in vec4 point;
layout(location = 0) out vec4 fc;

void main()
{
    vec4 p = point;
    vec3 v = -normalize(p.xyz / p.w);
    vec3 l = normalize((pl * p.w - p * pl.w).xyz);
    vec3 n = normalize(cross(dFdx(p.xyz), dFdy(p.xyz)));
    vec3 h = normalize(l + v);
    fc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;
}
