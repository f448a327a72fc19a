#version 410 core

// A right answer to flat: the colour comes from the triangle's last vertex, and is written out as it is.

flat in vec4 vc;
layout(location = 0) out vec4 fc;

void main()
{
    fc = vc;
}
