#version 410 core
layout (location = 0) in vec3 position;
struct Wave { vec2 direction; float amplitude, length; };
uniform Wave waves[2];
uniform float time;
uniform mat4 projection, view, model;
out vec4 tint;
float turns(int i)
{
  return dot(position.zx, waves[i].direction) / waves[i].length;
}
void main()
{
  float up = dot(vec2(waves[0].amplitude, waves[1].amplitude),
                 cos(radians(360.0 * vec2(turns(0), turns(1)) - 90.0) + time));
  // The second column of the matrices is where up leads to.
  mat4 all = projection * (view * model);
  gl_Position = all * vec4(position, 1.0) + up * all[1];
  tint = vec4(vec3(up), 0.0) + vec4(0.2, 0.4, 0.7, 1.0);
}
