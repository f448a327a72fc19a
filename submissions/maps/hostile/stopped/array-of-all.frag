#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;

void main()
{
  float a[100000]; a[int(at.x * 3.0) & 1] = at_texture.x; colour = vec4(a[int(at.y * 1e4) & 3]);
}
