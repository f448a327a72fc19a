#version 330 core
in vec3 position;
in vec2 coordinates;
uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
uniform float time;
uniform float height;
uniform float loose;
out vec3 facing;
out float sand;
out vec2 ripples;

void main()
{
  vec2 along = vec2(2.0, 1.0);
  float phase = dot(along, position.xz) - time;
  float rise = height * sin(phase);
  vec2 slope = height * cos(phase) * along;
  facing = normalize(transpose(inverse(mat3(model))) * vec3(-slope.x, 1.0, -slope.y));
  sand = smoothstep(-1.0, 1.0, loose * sin(phase));
  ripples = 4.0 * coordinates;
  gl_Position = projection * view * vec4(position.x, rise, position.z, 1.0);
}
