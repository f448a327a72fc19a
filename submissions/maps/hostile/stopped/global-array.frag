#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
mat4 a[9000];
void main()
{
  a[int(at.x * 3.0) & 7][1] = at_texture.xyxy; colour = a[int(at.y * 1e4) & 7][1];
}
