#version 410 core
// Precision qualifiers and statements mean nothing on the desktop.
precision highp float;
precision mediump int;
const highp vec4 pl = vec4(0, 0, 1, 0);
in highp vec4 pv;
in mediump vec4 cv;
uniform highp mat4 mw, mc;
uniform lowp mat4 mg;
out highp vec4 vc;
lowp float positive(mediump float x) { return max(x, 0.0); }
void main()
{
    highp vec3 n = normalize((mg * cv).xyz), v = -normalize((mw * pv).xyz), h = normalize(pl.xyz + v);
    lowp float d = positive(dot(n, pl.xyz));
    mediump int e = 80;
    vc = vec4(.12, 0, 0, 1) + d * vec4(.6, 0, 0, 0) + pow(positive(dot(n, h)), float(e)) * vec4(.4, .4, .4, 0);
    gl_Position = mc * pv;
}
