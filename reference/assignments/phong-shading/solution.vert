#version 410 core

// A right answer to phong-shading, vertex stage: it hands on what the equation needs at each pixel, and as it is interpolated
// without harm. What assignment.toml replaces stands here, or in solution.frag, once.

layout (location = 0) in vec4 pv;
in vec4 cv;

uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

out vec4 eyePosition;
out vec3 eyeNormal;

void main()
{
    eyePosition = mw * pv;
    eyeNormal = normalize((mg * cv).xyz);
    gl_Position = mc * pv;
}
