#version 330 core
in vec3 aPos, aNormal;
uniform mat4 model, view, projection;
uniform vec3 lightPos, viewPos;
out vec3 toLight, toEye, Normal;
void main()
{
  vec4 world = model * vec4(aPos, 1.0);
  toLight = lightPos - world.xyz; toEye = viewPos - world.xyz;
  Normal = mat3(transpose(inverse(model))) * aNormal;
  gl_Position = projection * view * world;
}
