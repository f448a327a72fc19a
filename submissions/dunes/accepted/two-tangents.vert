#version 410 core
in vec4 position;
in vec2 coordinates;
uniform mat4 model, view, projection;
uniform float time, height, loose;
out vec3 facing;
out vec2 ripples;
out float sand;

float wave(vec2 p, float shift) { return sin(2.0 * p.x + p.y - time + shift); }

void main()
{
  float s = wave(position.xz, 0.0), c = wave(position.xz, radians(90.0));
  vec3 east = mat3(model) * vec3(1.0, 2.0 * height * c, 0.0);
  vec3 south = mat3(model) * vec3(0.0, height * c, 1.0);
  facing = cross(south, east) / length(cross(south, east));
  float t = clamp(0.5 * (loose * s + 1.0), 0.0, 1.0);
  sand = t * t * (3.0 - t - t);
  ripples = coordinates + coordinates * 3.0;
  vec4 moved = position;
  moved.y += height * s - position.y;
  gl_Position = projection * (view * (model * moved));
}
