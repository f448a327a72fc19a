#version 330
in vec4 pv;
in vec4 cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
void main() {
    vc = lamb * kamb;
    gl_Position = mc * pv;
}
