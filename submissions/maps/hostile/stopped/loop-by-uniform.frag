#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;

void main()
{
  for (int i = 0; i != int(at.y * 1e4); i += 2) colour.x += 1.0;
}
