#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
#define A at_texture.x + at_texture.x + at_texture.x + at_texture.x
#define B A + A + A + A
#define C B + B + B + B
#define D C + C + C + C
#define E D + D + D + D
#define F E + E + E + E
#define G F + F + F + F
#define H G + G + G + G

void main()
{
  colour = vec4(H);
}
