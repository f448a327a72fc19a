#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
float f(float x) { if (x < 2.0) discard; return x; }
void main()
{
  colour = vec4(f(at_texture.x));
}
