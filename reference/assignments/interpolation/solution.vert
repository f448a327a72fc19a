#version 410 core

// A right answer to interpolation, vertex stage: one coordinate, handed over in three ways. What assignment.toml replaces stands
// here, or in solution.frag, once.

layout (location = 0) in vec4 pv;
in vec2 tv;

uniform mat4 mc;

smooth out float across;
noperspective out float straight;
flat out float last;

void main()
{
    vec4 position = mc * pv;
    across = tv.x;
    straight = tv.x;
    last = tv.x;
    gl_Position = position;
}
