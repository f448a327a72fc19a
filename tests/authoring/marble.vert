#version 330 core
layout(location = 0) in vec3 aPos;
layout(location = 1) in vec3 aNormal;
layout(location = 2) in vec2 aTexCoords;
uniform mat4 model, view, projection;
uniform vec3 lightPos, viewPos;
uniform int bands;
out vec3 normal;
out vec3 towards[2];
flat out int band;
out vec2 coords;

void main()
{
  vec4 world = model * vec4(aPos, 1.0);
  normal = transpose(inverse(mat3(model))) * aNormal;
  towards[0] = lightPos - world.xyz;
  towards[1] = viewPos - world.xyz;
  band = int(aTexCoords.y * float(bands));
  coords = aTexCoords;
  gl_Position = projection * view * world;
}
