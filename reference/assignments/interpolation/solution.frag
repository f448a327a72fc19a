#version 410 core

// A right answer to interpolation, fragment stage: red and green are stripes, blue is a number for each triangle.

const float count = 6.0;

smooth in float across;
noperspective in float straight;
flat in float last;

layout (location = 0) out vec4 fc;

float stripes(float c)
{
    return 0.5 - 0.5 * cos(6.2831853 * count * c);
}

void main()
{
    float red = stripes(across);
    float green = stripes(straight);
    float blue = last;
    fc = vec4(red, green, blue, 1.0);
}
