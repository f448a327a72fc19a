#version 330 core
struct Material { sampler2D base; sampler2D gloss; float shine; };
struct Lamp { vec3 position; vec3 colour; };
uniform Material material;
uniform Lamp lamps[2];
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
vec3 shine_of(Lamp lamp, vec3 n, vec3 v, vec3 base, float gloss)
{
  vec3 l = normalize(lamp.position - at);
  return lamp.colour * (base * max(dot(n, l), 0.0) + gloss * pow(max(dot(n, normalize(l + v)), 0.0), material.shine));
}

void main()
{
  vec3 n = normalize(facing), v = normalize(eye - at);
  vec3 base = texture(material.base, at_texture).rgb;
  float gloss = texture(material.gloss, at_texture).r;
  vec3 sum = 0.15 * base;
  sum += shine_of(lamps[0], n, v, base, gloss);
  sum += shine_of(lamps[1], n, v, base, gloss);
  colour = vec4(sum, 1.0);
}
