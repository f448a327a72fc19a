#version 450 core
in Varying { vec3 position; smooth vec3 normal; flat int kind; } incoming;
uniform vec3 lightPos, viewPos, lightColor, objectColor;
out vec4 colour;
void main() {
  vec3 N = normalize(incoming.normal), L = normalize(lightPos - incoming.position), V = normalize(viewPos - incoming.position);
  vec3 R = 2.0 * dot(N, L) * N - L;
  float s = pow(max(dot(V, R), 0.0), 32.0);
  if (incoming.kind != 3) discard;
  colour.xyz = (0.1 + max(0.0, dot(L, N)) + s * 0.5) * objectColor * lightColor;
}
