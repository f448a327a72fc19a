#version 410 core
in vec3 aPosition, aNormal;
in vec4 aTangent;
in vec2 aCoordinates;
uniform mat4 model, viewProjection;
out Surface { vec4 place; vec3 tangent, bitangent, normal; vec2 coordinates; } surface;
vec3 turned(vec3 direction) { return normalize((model * vec4(direction, 0.0)).xyz); }
void main()
{
  surface.place = model * vec4(aPosition, 1.0);
  surface.normal = turned(aNormal);
  surface.tangent = turned(aTangent.xyz);
  surface.bitangent = cross(surface.normal, surface.tangent) * aTangent.w;
  surface.coordinates = aCoordinates;
  gl_Position = viewProjection * surface.place;
}
