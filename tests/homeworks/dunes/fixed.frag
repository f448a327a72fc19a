#version 330 core
in vec3 facing;
in float sand;
in vec2 ripples;
uniform vec3 sun;
out vec4 colour;

void main()
{
  float light = 0.5 + 0.5 * dot(facing, normalize(sun));
  float wind = 0.75 + 0.25 * sin(3.0 * (ripples.x + ripples.y));
  colour = vec4(light * wind * mix(vec3(0.6, 0.5, 0.3), vec3(0.9, 0.8, 0.6), sand), 1.0);
}
