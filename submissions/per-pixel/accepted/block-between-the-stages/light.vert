#version 450 core
layout(location = 3) in vec4 aPos;
layout(location = 1) in vec3 aNormal;
uniform mat4 model; uniform mat4 view; uniform mat4 projection;
out Varying { vec3 position; smooth vec3 normal; flat int kind; } outgoing;
void main() {
  outgoing.position = (model * aPos).xyz;
  outgoing.normal = inverse(transpose(mat3(model))) * aNormal;
  outgoing.kind = 3;
  gl_Position = projection * (view * (model * vec4(aPos.xyz, 1.0)));
}
