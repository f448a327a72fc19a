#version 410 core

// A right answer to several-lights: the illumination equation of lecture 6 with global ambient light, emission and two lights
// (slide 38), computed in eye space. The names in main are what assignment.toml speaks of; 1 and 2 are the lights.

// What is everywhere, and what the surface sends out by itself.
const vec4 lglob = vec4(0.15, 0.12, 0.1, 1.0);
const vec4 lemi = vec4(0.02, 0.05, 0.09, 0.0);

// The lights: their positions (w = 1: points), and what they send out.
const vec4 pl1 = vec4(2.0, 1.6, -2.5, 1.0);
const vec4 lamb1 = vec4(0.2, 0.18, 0.14, 0.0);
const vec4 ldiff1 = vec4(1.6, 1.4, 1.1, 0.0);
const vec4 lspec1 = vec4(1.5, 1.3, 1.2, 0.0);
const vec4 pl2 = vec4(-2.2, 0.9, -6.4, 1.0);
const vec4 lamb2 = vec4(0.05, 0.08, 0.11, 0.0);
const vec4 ldiff2 = vec4(0.7, 0.8, 1.9, 0.0);
const vec4 lspec2 = vec4(0.6, 0.9, 1.7, 0.0);

// How they fade with distance: constant, linear and quadratic coefficient.
const float sc = 0.3;
const float sl = 0.13;
const float sq = 0.07;

// The surface: what it sends back of all that.
const vec4 kamb = vec4(0.5, 0.11, 0.1, 1.0);
const vec4 kdiff = vec4(0.7, 0.16, 0.12, 1.0);
const vec4 kspec = vec4(0.4, 0.35, 0.3, 1.0);
const float kshi = 16.0;

layout (location = 0) in vec4 pv;
in vec4 cv;

uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

out vec4 vc;

void main()
{
    // Vectors of length 1: to the eye, of the surface, to each light, and half way between eye and light.
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w);
    vec3 n = normalize((mg * cv).xyz);
    vec3 l1 = normalize((pl1 * p.w - p * pl1.w).xyz);
    vec3 l2 = normalize((pl2 * p.w - p * pl2.w).xyz);
    vec3 h1 = normalize(l1 + v);
    vec3 h2 = normalize(l2 + v);

    // The distance of each light, and how much of it arrives.
    float r1 = distance(pl1.xyz / pl1.w, p.xyz / p.w);
    float r2 = distance(pl2.xyz / pl2.w, p.xyz / p.w);
    float d1 = 1.0 / (sc + sl * r1 + sq * r1 * r1);
    float d2 = 1.0 / (sc + sl * r2 + sq * r2 * r2);

    // No light from behind the surface.
    float nl1 = dot(n, l1);
    float nl2 = dot(n, l2);
    float lambert1 = max(nl1, 0.0);
    float lambert2 = max(nl2, 0.0);
    float nh1 = dot(n, h1);
    float nh2 = dot(n, h2);
    float facing1 = max(nh1, 0.0);
    float facing2 = max(nh2, 0.0);
    float highlight1 = pow(facing1, kshi);
    float highlight2 = pow(facing2, kshi);

    // The terms of each light.
    vec4 ambient1 = kamb * lamb1;
    vec4 ambient2 = kamb * lamb2;
    vec4 diffuse1 = lambert1 * kdiff * ldiff1;
    vec4 diffuse2 = lambert2 * kdiff * ldiff2;
    vec4 specular1 = highlight1 * kspec * lspec1;
    vec4 specular2 = highlight2 * kspec * lspec2;

    // Each light by itself; mistakes in the sum are written with these.
    vec4 first = ambient1 + d1 * (diffuse1 + specular1);
    vec4 second = ambient2 + d2 * (diffuse2 + specular2);

    // All of it: only diffuse and specular light fade.
    vec4 global = kamb * lglob;
    vec4 emission = lemi;
    vec4 ambient = ambient1 + ambient2;
    vec4 diffuse = d1 * diffuse1 + d2 * diffuse2;
    vec4 specular = d1 * specular1 + d2 * specular2;
    vec4 total = global + emission + ambient + diffuse + specular;

    // What is written out.
    vec4 colour = total;
    vec4 position = mc * pv;
    vc = colour;
    gl_Position = position;
}
