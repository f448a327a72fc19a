#version 330 core
uniform mat4 model, viewProjection;
in vec3 position;
out vec3 at;
void main()
{
  vec4 world = model * vec4(position, 1.0);
  at = world.xyz;
  gl_Position = viewProjection * world;
}
