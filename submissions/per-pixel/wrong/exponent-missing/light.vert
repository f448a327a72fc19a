#version 330 core
in vec3 aPos, aNormal;
uniform mat4 model, view, projection;
out vec3 FragPos, Normal;
void main()
{
  vec4 world = model * vec4(aPos, 1.0);
  FragPos = world.xyz;
  Normal = mat3(transpose(inverse(model))) * aNormal;
  gl_Position = projection * view * world;
}
