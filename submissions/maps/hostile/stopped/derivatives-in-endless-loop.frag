#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;

void main()
{
  vec2 a = at_texture; while (a.x < 1e9) { a += dFdx(a) * 0.0 + fwidth(a) * 0.0; } colour = a.xyxy;
}
