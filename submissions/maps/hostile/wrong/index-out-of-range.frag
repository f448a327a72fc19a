#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;

void main()
{
  float a[4] = float[4](1., 2., 3., 4.); colour = vec4(a[int(at.x * 3.0) * 1000], a[-int(at.x * 3.0) * 77], 0.0, 1.0);
}
