#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;

void main()
{
  if (at_texture.x < 0.5) colour = dFdx(at_texture.xyxy); else colour = dFdy(at_texture.xyxy) + fwidth(facing.xyzx);
}
