#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;

void main()
{
  float d = dFdx(at_texture.x); while (d < 1e30) { d = d * 0.5; } colour = vec4(d);
}
