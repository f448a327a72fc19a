#version 410 core
in vec4 pv;
in vec4 cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main(void)
{
}
