#version 330 core
uniform vec3 eye, fogColour;
uniform float density;
in vec3 at;
out vec4 colour;
void main()
{
  float depth = density * abs(eye.z - at.z);
  float clear = exp(-depth * depth);
  vec3 own = vec3(0.2, 0.3, 0.4) + 0.2 * at.y;
  vec4 mixed = vec4(mix(fogColour, own, clear), 1.0);
  colour = mixed;
}
