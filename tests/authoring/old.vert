#version 150
in vec4 vertex;
in vec3 normal;
uniform mat4 modelViewProjection;
out vec3 shade;
out vec2 place;
void main()
{
    shade = 0.5 + 0.5 * normal;
    place = vertex.xy;
    gl_Position = modelViewProjection * vertex;
}
