#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;

void main()
{
  colour = texelFetch(material.base, ivec2(-2147483647, 2147483647), int(at.x * 3.0) * 9);
}
