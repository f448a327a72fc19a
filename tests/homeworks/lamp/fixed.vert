#version 330 core
uniform mat4 model, viewProjection;
uniform mat3 worldNormal;
in vec3 position, normal;
out vec3 at, facing;
void main()
{
  vec4 world = model * vec4(position, 1.0);
  at = world.xyz;
  facing = worldNormal * normal;
  gl_Position = viewProjection * world;
}
