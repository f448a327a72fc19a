#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;

void main()
{
  switch (int(at.x * 3.0)) { case 0: while (true) colour.x += 1.0; default: while (true) colour.y += 1.0; }
}
