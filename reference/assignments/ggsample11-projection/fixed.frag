#version 410 core

// The light of the vertices, interpolated.

in vec4 vc;

layout (location = 0) out vec4 fc;

void main()
{
    fc = vc;
}
