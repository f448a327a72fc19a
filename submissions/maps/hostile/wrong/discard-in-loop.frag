#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;

void main()
{
  for (int i = 0; i < 100; i++) if (float(i) > at_texture.x * 50.0) discard; colour = vec4(1.0);
}
