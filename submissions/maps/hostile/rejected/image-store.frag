#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
layout(rgba8) uniform image2D target;
void main()
{
  imageStore(target, ivec2(at_texture), vec4(1.0)); colour = vec4(1.0);
}
