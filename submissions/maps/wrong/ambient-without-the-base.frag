#version 330 core
struct Material { sampler2D base; sampler2D gloss; float shine; };
struct Lamp { vec3 position; vec3 colour; };
uniform Material material;
uniform Lamp lamps[2];
uniform vec3 eye;
in vec3 at, facing;
in vec2 at_texture;
out vec4 colour;
void main()
{
  vec3 n = normalize(facing), v = normalize(eye - at);
  vec3 base = texture(material.base, at_texture).rgb;
  float gloss = texture(material.gloss, at_texture).r;
  const float ambient = 0.15;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 2; i++) {
    vec3 l = normalize(lamps[i].position - at);
    vec3 h = normalize(l + v);
    sum += base * lamps[i].colour * max(dot(n, l), 0.0);
    sum += gloss * lamps[i].colour * pow(max(dot(n, h), 0.0), material.shine);
  }
  sum += ambient;
  colour = vec4(sum, 1.0);
}
