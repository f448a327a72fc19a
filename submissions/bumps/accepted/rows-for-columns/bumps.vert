#version 330 core
layout (location = 0) in vec4 aPosition;
in vec3 aNormal;
in vec4 aTangent;
in vec2 aCoordinates;
uniform mat4 model, viewProjection;
uniform vec3 light;
// From directions of the world to those of the surface, and both texture coordinates behind the way to the light.
out mat3 toSurface;
out vec3 toLight;
out vec4 st;
void main()
{
  mat3 turn = mat3(model);
  vec3 z = turn * aNormal, x = turn * aTangent.xyz;
  x *= inversesqrt(dot(x, x));
  z /= length(z);
  vec3 y = aTangent.w < 0.0 ? cross(x, z) : cross(z, x);
  toSurface = transpose(mat3(x, y, z));
  vec4 place = model * aPosition;
  toLight = light - place.xyz;
  st = aCoordinates.xyxy;
  gl_Position = viewProjection * place;
}
