#version 410 core
in Surface { vec4 place; vec3 tangent, bitangent, normal; vec2 coordinates; } surface;
uniform vec3 light;
uniform sampler2D paint, relief;
layout (location = 0) out vec4 colour;
vec3 bent()
{
  vec3 texel = texture(relief, surface.coordinates).xyz;
  vec3 lean = (texel - 0.5) / 0.5;
  return normalize(lean.x * surface.tangent + lean.y * surface.bitangent + lean.z * surface.normal);
}
float brightness(vec3 n)
{
  float cosine = dot(n, normalize(light - surface.place.xyz));
  return cosine > 0.0 ? 0.44 + 0.8 * cosine : 0.2;
}
void main()
{
  colour.rgb = brightness(bent()) * texture(paint, surface.coordinates).rgb;
  colour.a = 1.0;
}
