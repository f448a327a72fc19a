#version 330 core
struct Material { sampler2D base; sampler2D gloss; float shine; };
struct Lamp { vec3 position; vec3 colour; };
uniform Material material;
uniform Lamp lamps[2];
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
vec3 light(Lamp lamp, vec3 n, vec3 v, vec3 base, float gloss)
{
  vec3 l = normalize(lamp.position - at);
  vec3 h = l + v;
  float d = max(dot(n, l), 0.0);
  float s = pow(max(dot(n, h), 0.0), material.shine);
  return (base * d + gloss * s) * lamp.colour;
}
void main()
{
  vec3 n = normalize(facing);
  vec3 v = normalize(eye - at);
  vec4 texel = texture(material.base, at_texture);
  float g = texture(material.gloss, at_texture).r;
  vec3 c = 0.15 * texel.rgb;
  c += light(lamps[0], n, v, texel.rgb, g);
  c += light(lamps[1], n, v, texel.rgb, g);
  colour = vec4(c, 1.0);
}
