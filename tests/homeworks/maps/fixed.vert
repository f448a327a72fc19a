#version 330 core
uniform mat4 model, viewProjection;
uniform mat3 worldNormal;
in vec3 position, normal;
in vec2 coordinates;
out vec3 at, facing;
out vec2 at_texture;
void main()
{
  vec4 world = model * vec4(position, 1.0);
  at = world.xyz;
  facing = worldNormal * normal;
  at_texture = coordinates;
  gl_Position = viewProjection * world;
}
