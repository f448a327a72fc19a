#version 330 core
struct Wave { vec2 direction; float amplitude; float length; };
uniform Wave waves[2];
uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
uniform float time;
in vec3 position;
out vec4 tint;
void raise(in Wave wave, inout vec3 place, inout vec3 colour)
{
  float steps = 6.2831853 * dot(wave.direction, position.xz);
  float by = sin(steps / wave.length + time) * wave.amplitude;
  place.y += by;
  colour += vec3(by);
}
void main()
{
  vec3 place = position, colour = vec3(0.2, 0.4, 0.7);
  raise(waves[0], place, colour);
  raise(waves[1], place, colour);
  tint.rgb = colour;
  tint.w = 1.0;
  gl_Position = vec4(place, 1.0) * transpose(model) * transpose(view) * transpose(projection);
}
