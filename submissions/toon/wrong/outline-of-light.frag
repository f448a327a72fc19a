#version 330 core
struct Lamp { vec3 position; vec3 colour; };
uniform Lamp lamp;
uniform vec3 eye;
uniform int tones;
in vec3 at, facing;
out vec4 tint;

float edge(vec3 n, vec3 d) { return dot(n, d); }
void main()
{
  vec3 n = normalize(facing), l = normalize(lamp.position - at), v = normalize(eye - at);
  float k = floor(max(dot(n, l), 0.0) * float(tones)) / float(tones);
  vec3 colour = lamp.colour * (0.2 + 0.8 * k);
  if (edge(n, l) < 0.3) colour = vec3(0.1);
  tint = vec4(colour, 1.0);
}
