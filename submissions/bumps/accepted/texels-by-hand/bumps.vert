#version 330 core
in vec3 aPosition, aNormal;
in vec4 aTangent;
in vec2 aCoordinates;
uniform mat4 model, viewProjection;
out vec3 at;
out mat3 frame;
out vec2 coordinates;
void main()
{
  vec4 world = model * vec4(aPosition, 1.0);
  vec3 n = normalize(mat3(model) * aNormal), t = normalize(mat3(model) * aTangent.xyz);
  at = world.xyz;
  frame = mat3(t, cross(n, t) * aTangent.w, n);
  coordinates = aCoordinates;
  gl_Position = viewProjection * world;
}
