#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;

void main()
{
  for (int i = 0; i < 40000; i++) { colour = sin(cos(tan(exp(sin(cos(tan(colour + at_texture.xyxy))))))); colour = pow(abs(colour), at_texture.xyxy) + atan(colour) + sin(cos(tan(exp(sin(cos(tan(colour))))))); }
}
