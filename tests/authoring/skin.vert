#version 330 core
// A mesh on four bones, each vertex moved by several of them.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in ivec4 boneIds;
layout(location = 3) in vec4 boneWeights;

uniform mat4 bones[4];
uniform mat4 model, view, projection;
uniform vec3 lightDir;
uniform vec3 skinColor;

out vec3 shade;

void main()
{
    mat4 skin = mat4(0.0);
    for (int i = 0; i < 4; i++)
        skin += boneWeights[i] * bones[boneIds[i]];
    vec4 world = model * skin * vec4(position, 1.0);
    vec3 n = normalize(mat3(model) * mat3(skin) * normal);
    float lambert = max(dot(n, normalize(-lightDir)), 0.0);
    shade = skinColor * (0.2 + 0.8 * lambert);
    gl_Position = projection * view * world;
}
