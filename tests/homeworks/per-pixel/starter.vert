#version 330 core
in vec3 aPos, aNormal;
uniform mat4 model, view, projection;
out vec3 FragPos, Normal;
void main()
{
  FragPos = aPos;
  Normal = aNormal;
  gl_Position = vec4(aPos, 1.0);
}
