#version 410 core
in vec4 pv;
in vec4 cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main() {
    vc = vec4(0.66, 0.0, 0.0, 1.0);
    gl_Position = mc * pv;
}
