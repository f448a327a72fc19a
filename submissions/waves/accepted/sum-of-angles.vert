#version 330 core
struct Wave { vec2 direction; float amplitude; float length; };
in vec4 position;
uniform Wave waves[2];
uniform mat4 model, view, projection;
uniform float time;
out vec4 tint;
const float turn = 2.0 * 3.14159265358979;
void main()
{
  // sin(a + t) = sin a cos t + cos a sin t
  float s = sin(time), c = cos(time);
  float up = 0.0;
  for (int i = 1; i >= 0; --i) {
    float a = turn / waves[i].length * (waves[i].direction.x * position.x + waves[i].direction.y * position.z);
    up += waves[i].amplitude * (sin(a) * c + cos(a) * s);
  }
  vec4 place = position;
  place.y += up;
  mat4 camera = projection * view;
  gl_Position = camera * (model * place);
  tint = vec4(0.2 + up, 0.4 + up, 0.7 + up, 1.0);
}
