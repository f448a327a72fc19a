#version 410 core
#include "lighting.glsl"
in vec4 pv;
in vec4 cv;
out vec4 vc;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
void main()
{
    vc = lighting(pv, cv);
    gl_Position = mc * pv;
}
