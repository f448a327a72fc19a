#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;

void main()
{
  if (int(gl_FragCoord.x) == 60 && int(gl_FragCoord.y) == 45) while (true) {} colour = vec4(1.0);
}
