#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
vec4 look_up(vec2 at) { return texture(material.base, at); } float detail_here = 1.0;
void main()
{
  colour = look_up(at_texture) * detail_here;
}
