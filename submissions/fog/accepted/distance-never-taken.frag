#version 330 core
in vec3 at;
uniform vec3 eye, fogColour;
uniform float density;
out vec4 colour;
void main()
{
  // Only the square of the distance is asked for.
  vec3 way = density * (eye - at);
  float veil = 1.0 - exp(-(way.x * way.x + way.y * way.y + way.z * way.z));
  colour = vec4(0.2, 0.3, 0.4, 1.0);
  for (int i = 0; i < 3; ++i) {
    colour[i] += at.y * 0.2;
    colour[i] = colour[i] * (1.0 - veil) + fogColour[i] * veil;
  }
}
