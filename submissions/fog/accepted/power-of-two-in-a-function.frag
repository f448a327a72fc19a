#version 410 core
in vec3 at;
uniform float density;
uniform vec3 eye;
uniform vec3 fogColour;
layout (location = 0) out vec4 pixel;
// How much of a surface is seen through so much air.
float seen(float way)
{
  const float perHalving = 1.4426950408889634;
  return exp2(-perHalving * pow(way, 2.0));
}
vec3 surface() { return vec3(2.0, 3.0, 4.0) / 10.0 + vec3(at.y / 5.0); }
void main()
{
  vec3 away = at - eye;
  float clear = seen(density * sqrt(dot(away, away)));
  pixel.a = 1.0;
  pixel.rgb = fogColour + (surface() - fogColour) * clear;
}
