#version 430
struct Material { sampler2D base; sampler2D gloss; float shine; };
uniform Material material;
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
layout(location = 1) out vec4 b; layout(location = 2) out vec4 c; layout(location = 3) out vec4 d;
void main()
{
  b = c = d = at_texture.xyxy; colour = vec4(1.0);
}
