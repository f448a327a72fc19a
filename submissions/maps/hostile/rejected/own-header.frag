#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
layout(std430) buffer capture { uint ran_out; };
void main()
{
  ran_out = 0u; colour = vec4(1.0);
}
