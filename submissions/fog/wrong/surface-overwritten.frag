#version 330 core
uniform vec3 eye, fogColour;
uniform float density;
in vec3 at;
out vec4 colour;
float visible(float distance)
{
  float x = distance * density;
  return exp(-(x * x));
}
void main()
{
  vec3 surface = vec3(0.2, 0.3, 0.4);
  surface = vec3(0.2 * at.y);
  float f = visible(distance(eye, at));
  vec3 c = f * surface + (1.0 - f) * fogColour;
  colour.rgb = c;
  colour.a = 1.0;
}
