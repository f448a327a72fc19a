#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
float f(float x) { return x < 0.0 ? x : f(x - 1.0); }
void main()
{
  colour = vec4(f(at_texture.x));
}
