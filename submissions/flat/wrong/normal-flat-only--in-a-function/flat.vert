#version 330 core

in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

flat out vec3 n;
out vec3 p;
void main() { n = (mg * cv).xyz; p = (mw * pv).xyz; gl_Position = mc * pv; }
