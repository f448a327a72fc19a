#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in ivec2 boneIds;
layout(location = 3) in vec2 weights;
uniform mat4 bones[3];
uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
uniform vec3 lightDirection;
uniform vec3 albedo;
out vec3 color;
void main()
{
    mat4 skin = weights.x * bones[boneIds.x] + weights.y * bones[boneIds.y];
    vec4 world = model * skin * vec4(position, 1.0);
    vec3 n = normalize(mat3(model) * mat3(skin) * normal);
    float diffuse = max(dot(n, normalize(lightDirection)), 0.0);
    color = albedo * (0.2 + 0.8 * diffuse);
    gl_Position = projection * view * world;
}
