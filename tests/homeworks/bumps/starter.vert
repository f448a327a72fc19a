#version 330 core
in vec3 aPosition, aNormal;
in vec4 aTangent;
in vec2 aCoordinates;
uniform mat4 model, viewProjection;
void main()
{
  gl_Position = viewProjection * model * vec4(0.9 * aPosition, 1.0);
}
