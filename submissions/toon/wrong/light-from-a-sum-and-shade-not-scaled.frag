#version 330 core
struct Lamp { vec3 position; vec3 colour; };
uniform Lamp lamp;
uniform vec3 eye;
uniform int tones;
in vec3 at, facing;
out vec4 tint;
void main()
{
  vec3 n = normalize(facing);
  vec3 l = normalize(lamp.position + at);
  float lit = max(dot(n, l), 0.0);
  lit = floor(lit * float(tones)) / float(tones);
  vec3 colour = lamp.colour * (0.2 + lit);
  if (dot(n, normalize(eye - at)) < 0.3) colour = vec3(0.1);
  tint = vec4(colour, 1.0);
}
