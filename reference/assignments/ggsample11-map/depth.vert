#version 410 core

// The pass of the shadow map: what is drawn as the light sees it.

uniform mat4 mv;
uniform mat4 mp;

layout (location = 0) in vec4 pv;

void main()
{
    gl_Position = mp * mv * pv;
}
