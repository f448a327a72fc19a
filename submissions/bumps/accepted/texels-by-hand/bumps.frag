#version 330 core
in vec3 at;
in mat3 frame;
in vec2 coordinates;
uniform vec3 light;
uniform sampler2D paint, relief;
out vec4 colour;
// The four texels around a place, mixed as a sampler mixes them.
vec3 read(sampler2D map, vec2 st)
{
  ivec2 size = textureSize(map, 0);
  vec2 place = st * vec2(size) - 0.5;
  ivec2 low = ivec2(floor(place));
  vec2 share = fract(place);
  vec3 sum = vec3(0.0);
  for (int j = 0; j < 2; j++)
    for (int i = 0; i < 2; i++) {
      ivec2 texel = (low + ivec2(i, j) + size) % size;
      float weight = (i == 0 ? 1.0 - share.x : share.x) * (j == 0 ? 1.0 - share.y : share.y);
      sum += weight * texelFetch(map, texel, 0).rgb;
    }
  return sum;
}
void main()
{
  vec3 n = frame * (2.0 * read(relief, coordinates) - 1.0);
  vec3 l = light - at;
  float cosine = dot(n, l) * inversesqrt(dot(n, n) * dot(l, l));
  colour = vec4(mix(0.2, 1.0, clamp(cosine, 0.0, 1.0)) * read(paint, coordinates), 1.0);
}
