#version 330 core
struct Material { sampler2D base; sampler2D gloss; float shine; };
struct Lamp { vec3 position; vec3 colour; };
uniform Material material;
uniform Lamp lamps[2];
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
void main()
{
  colour = vec4(1.0);
}
