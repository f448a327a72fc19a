#version 330 core
in vec3 at;
in mat3 frame;
in vec2 coordinates;
uniform vec3 light;
uniform sampler2D paint, relief;
out vec4 colour;
void main()
{
  vec3 n = normalize(frame * (2.0 * texture(relief, coordinates).xyz - 1.0));
  float lit = 0.2 + 0.8 * max(dot(n, normalize(light - at)), 0.0);
  colour = vec4(lit * texture(paint, coordinates).rgb, 1.0);
}
