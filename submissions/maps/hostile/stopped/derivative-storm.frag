#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
#define D(x) (dFdx(x) + dFdy(x) + fwidth(x))
#define E(x) D(D(D(D(D(D(D(x)))))))

void main()
{
  colour = E(sin(at_texture.xyxy));
}
