#version 410 core

// What the program draws, as a shader: where something is a shadow, it is drawn with the matrix whose numbers are handed in.

uniform mat4 model;
uniform mat4 view;
uniform mat4 mp;
uniform mat4 mn;

// What is drawn: 0 what it is, 1 its shadow, and at probes 2, where the place of the shadow is the colour.
uniform float shadow;

// The place of the light in the world.
uniform float lx;
uniform float ly;
uniform float lz;

uniform vec4 lamb;
uniform vec4 ldiff;
uniform vec4 lspec;

uniform vec4 kamb;
uniform vec4 kdiff;
uniform vec4 kspec;
uniform float kshi;

layout (location = 0) in vec4 pv;
layout (location = 1) in vec4 nv;

out vec4 vc;

void main()
{
    vec4 eye_light = view * vec4(lx, ly, lz, 1.0);
    vec4 world = model * pv;

    // ggrade: numbers

    vec4 x_column = vec4(m0, m1, m2, m3);
    vec4 y_column = vec4(m4, m5, m6, m7);
    vec4 z_column = vec4(m8, m9, m10, m11);
    vec4 w_column = vec4(m12, m13, m14, m15);
    mat4 m = mat4(x_column, y_column, z_column, w_column);

    // All matrices that are the same but for a positive factor draw the same.
    vec4 projected = m * world;
    vec4 on_floor = projected / max(length(projected), 1e-9);
    vec4 place = abs(shadow - 1.0) < 0.5 ? on_floor : world;

    // A place has four numbers, and its length is 1: three of them tell it.
    vec4 told = vec4(on_floor.x + on_floor.w, on_floor.y, on_floor.z + 2.0 * on_floor.w, 1.0);

    // The light of the vertices. What is in shadow has the ambient light alone.
    vec4 p = view * world;
    vec3 v = normalize(p.xyz);
    vec3 l = normalize(eye_light.xyz - p.xyz);
    vec3 n = normalize((mn * nv).xyz);
    vec3 h = normalize(l - v);
    vec4 ambient = kamb * lamb;
    vec4 diffuse = max(dot(n, l), 0.0) * kdiff * ldiff;
    vec4 specular = pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;

    vec4 shaded = ambient + diffuse + specular;
    vec4 colour = shadow > 1.5 ? told : shaded;
    vec4 position = mp * (view * place);
    vc = colour;
    gl_Position = position;
}
