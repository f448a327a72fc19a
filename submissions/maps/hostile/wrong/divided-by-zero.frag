#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;

void main()
{
  colour = vec4(float(int(at.x * 3.0) / (int(at.y * 1e4) + 3)), float(int(at.x * 3.0) % (int(at.y * 1e4) + 3)), 0.0, 1.0);
}
