#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
struct A { vec4 a[40]; }; struct B { A a[40]; }; struct C { B b[40]; };
void main()
{
  C c; c.b[int(at.x * 3.0) & 1].a[1].a[2] = at_texture.xyxy; colour = c.b[1].a[int(at.x * 3.0) & 1].a[2];
}
