#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
layout(std430, binding = 0) buffer All { uint words[]; };
void main()
{
  words[int(at.x * 3.0)] = 7u; colour = vec4(1.0);
}
