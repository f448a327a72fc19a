#version 410 core

// Another reading of spot-directx, with the law of Direct3D itself between the cones: the sum of lecture 6 (slide 31) with Blinn's half vector (slide 21), and
// a spotlight with the two cones of DirectX.
// Computed in eye space. The names in main are what assignment.toml speaks of.

// The light: its position (w = 1: a point), and what it sends out.
const vec4 pl = vec4(1.6, 1.4, -3.4, 1.0);
const vec4 lamb = vec4(0.25, 0.25, 0.3, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 0.95, 0.7, 0.0);

// The surface: what it sends back of that.
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.75, 0.12, 0.08, 1.0);
const vec4 kspec = vec4(0.4, 0.42, 0.45, 1.0);
const float kshi = 40.0;

// The spotlight: its axis in eye space, away from the light, how narrow it is, and the half angles of its cones in degrees.
const vec4 ldir = vec4(-0.9, -0.6, -1.0, 0.0);
const float sexp = 6.0;
const float thetap = 12.0;
const float thetau = 26.0;

layout (location = 0) in vec4 pv;
in vec4 cv;

uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

out vec4 vc;

void main()
{
    // Vectors of length 1: to the eye, to the light, of the surface, and half way between the first two.
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w);
    vec3 l = normalize((pl * p.w - p * pl.w).xyz);
    vec3 n = normalize((mg * cv).xyz);
    vec3 h = normalize(l + v);

    // How far light and eye are apart, seen from the surface: only probes ask for it.
    float lv = dot(l, v);

    // How much of the light goes this way: all within the inner cone, nothing outside of the outer one.
    vec3 axis = normalize(ldir.xyz);
    float ls = dot(-l, axis);
    float cp = cos(radians(thetap));
    float cu = cos(radians(thetau));
    float fading = pow(max(ls, 0.0), sexp);
    float limited = pow(clamp((ls - cu) / (cp - cu), 0.0, 1.0), sexp);
    float c = ls >= cp ? 1.0 : limited;

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
    vec4 total = c * (ambient + diffuse + specular);

    // What is written out.
    vec4 colour = total;
    vec4 position = mc * pv;
    vc = colour;
    gl_Position = position;
}
