#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;

void main()
{
  colour = vec4(1.0 / (at_texture.x * 0.0), -1.0 / (at_texture.y * 0.0), 1e38 * (at_texture.x + 9.0), 1.0);
}
