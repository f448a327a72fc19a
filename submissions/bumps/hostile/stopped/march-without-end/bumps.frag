#version 330 core
in vec3 at;
in mat3 frame;
in vec2 coordinates;
uniform vec3 light;
uniform sampler2D paint, relief;
out vec4 colour;
void main()
{
  // A search along the relief that never finds its surface.
  vec2 place = coordinates;
  float depth = 0.0;
  while (depth < 2.0) {
    depth = texture(relief, place).z;
    place += 0.001 * texture(relief, place).xy;
  }
  vec3 n = normalize(frame * (2.0 * texture(relief, place).xyz - 1.0));
  colour = vec4((0.2 + 0.8 * max(dot(n, normalize(light - at)), 0.0)) * texture(paint, place).rgb, 1.0);
}
