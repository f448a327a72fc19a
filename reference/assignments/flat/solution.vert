#version 410 core

// A right answer to flat: the illumination equation of lecture 6 (slide 31) at each vertex, and one vertex's colour for the
// whole triangle. What assignment.toml replaces stands here once.

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

layout (location = 0) in vec4 pv;
in vec4 cv;

uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

flat out vec4 vc;
out vec4 point;

void main()
{
    // Vectors of length 1: to the eye, to the light, of the surface, and half way between the first two.
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w);
    vec3 l = normalize((pl * p.w - p * pl.w).xyz);
    vec3 n = normalize((mg * cv).xyz);
    vec3 h = normalize(l + v);

    // No light from behind the surface.
    float nl = dot(n, l);
    float lambert = max(nl, 0.0);
    float nh = dot(n, h);
    float facing = max(nh, 0.0);
    float highlight = pow(facing, kshi);

    // The three terms.
    vec4 ambient = kamb * lamb;
    vec4 diffuse = lambert * kdiff * ldiff;
    vec4 specular = highlight * kspec * lspec;
    vec4 total = ambient + diffuse + specular;

    // What is written out.
    vec4 colour = total;
    vec4 position = mc * pv;
    point = p;
    vc = colour;
    gl_Position = position;
}
