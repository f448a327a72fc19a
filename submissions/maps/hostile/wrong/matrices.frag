#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;

void main()
{
  mat4 m = mat4(at_texture.x); for (int i = 0; i < 300; i++) m = inverse(m + mat4(0.5)) * transpose(m); colour = m[1];
}
