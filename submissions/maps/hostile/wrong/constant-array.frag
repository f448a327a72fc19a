#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;

void main()
{
  const float a[8] = float[8](1., 2., 3., 4., 5., 6., 7., 8.); colour = vec4(a[int(at.x * 3.0) & 7] / 8.0);
}
