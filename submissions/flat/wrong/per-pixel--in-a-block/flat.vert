#version 410 core

layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

out Varying { vec3 n; vec4 p; } o;
void main() { o.n = normalize((mg * cv).xyz); o.p = mw * pv; gl_Position = mc * pv; }
