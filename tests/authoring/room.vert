#version 330 core
layout(location = 0) in vec3 aPos;
layout(location = 1) in vec3 aNormal;

uniform mat4 model;
uniform mat4 viewProj;
uniform mat3 normalMatrix;

out vec3 wPos;
out vec3 wNormal;

void main()
{
    vec4 world = model * vec4(aPos, 1.0);
    wPos = world.xyz;
    wNormal = normalMatrix * aNormal;
    gl_Position = viewProj * world;
}
