#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
#define T(x) texture(material.base, x).xy
#define U(x) T(T(T(T(T(T(T(T(x))))))))
#define V(x) U(U(U(U(x))))

void main()
{
  colour = V(V(V(at_texture))).xyxy;
}
