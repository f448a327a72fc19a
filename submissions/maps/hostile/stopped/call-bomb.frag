#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
float a(float x) { return sin(x) + cos(x); } float b(float x) { return a(a(a(a(x)))) + a(x); }
float c(float x) { return b(b(b(b(x)))) + b(x); } float d(float x) { return c(c(c(c(x)))) + c(x); }
float e(float x) { return d(d(d(d(x)))) + d(x); }
void main()
{
  colour = vec4(e(e(at_texture.x)));
}
