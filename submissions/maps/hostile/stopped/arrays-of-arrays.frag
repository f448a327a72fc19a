#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;

void main()
{
  vec4 a[64][64][64]; a[1][2][int(at.x * 3.0) & 1] = at_texture.xyxy; colour = a[int(at.x * 3.0) & 3][1][2];
}
