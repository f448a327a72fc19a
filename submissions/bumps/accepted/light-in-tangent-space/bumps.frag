#version 330 core
in vec3 toLight;
in vec2 coordinates;
uniform sampler2D paint, relief;
out vec4 colour;
void main()
{
  vec3 n = normalize(2.0 * texture(relief, coordinates).xyz - 1.0);
  float lit = 0.2 + 0.8 * max(dot(n, normalize(toLight)), 0.0);
  colour = vec4(lit * texture(paint, coordinates).rgb, 1.0);
}
