#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
layout(std430, binding = 1) buffer All { uint words[]; };
void main()
{
  colour = vec4(float(words[99999999]));
}
