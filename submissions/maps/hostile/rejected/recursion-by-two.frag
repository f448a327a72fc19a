#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
float g(float x); float f(float x) { return g(x); } float g(float x) { return f(x); }
void main()
{
  colour = vec4(f(at_texture.x));
}
