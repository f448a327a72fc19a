#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec3 worldPos;
layout(location = 1) out vec3 worldNormal;
uniform mat4 model;
uniform mat4 viewProj;
void main() {
    vec4 w = model * vec4(position, 1.0);
    worldPos = w.xyz;
    worldNormal = transpose(inverse(mat3(model))) * normal;
    gl_Position = viewProj * w;
}
