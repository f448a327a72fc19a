#version 330 core

struct Wave { vec2 direction; float amplitude; float length; };

in vec3 position;
uniform mat4 model, view, projection;
uniform float time;
uniform Wave waves[2];
out vec4 tint;

void main()
{
    // Move the vertex up and down.
    tint = vec4(0.2, 0.4, 0.7, 1.0);
    gl_Position = projection * view * model * vec4(position, 1.0);
}
