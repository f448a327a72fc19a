#version 330
#define SQUARED(x) ((x) * (x))
#define RAMP(from, to, share) ((from) + (share) * ((to) - (from)))
in vec3 at;
uniform vec3 eye, fogColour;
uniform float density;
out vec3 colour;
void main()
{
  float thick = SQUARED(density) * (SQUARED(at.x - eye.x) + SQUARED(at.y - eye.y) + SQUARED(at.z - eye.z));
  mat2x3 both = mat2x3(0.2 * at.yyy + vec3(0.2, 0.3, 0.4), fogColour);
  float clear = 1.0 / exp(thick);
  colour = both * vec2(clear, RAMP(1.0, 0.0, clear));
}
