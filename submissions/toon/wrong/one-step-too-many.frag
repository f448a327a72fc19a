#version 330 core
struct Lamp { vec3 position; vec3 colour; };
uniform Lamp lamp;
uniform vec3 eye;
uniform int tones;
in vec3 at, facing;
out vec4 tint;
float quantise(float x, int n)
{
  float steps = float(n) + 1.0;
  return floor(x * steps) / steps;
}
void main()
{
  vec3 normal = normalize(facing);
  vec3 toLamp = normalize(lamp.position - at);
  vec3 toEye = normalize(eye - at);
  float brightness = quantise(clamp(dot(normal, toLamp), 0.0, 1.0), tones);
  float edge = dot(normal, toEye);
  vec3 base = lamp.colour * mix(0.2, 1.0, brightness);
  if (edge >= 0.3) {
    tint = vec4(base, 1.0);
  } else {
    tint = vec4(0.1, 0.1, 0.1, 1.0);
  }
}
