#version 330 core

struct Wave { vec2 direction; float amplitude; float length; };

in vec3 position;
uniform mat4 model, view, projection;
uniform float time;
uniform Wave waves[2];
out vec4 tint;

float height(Wave wave, vec2 place)
{
    return wave.amplitude * sin(dot(wave.direction, place) * 6.2831853 / wave.length - time);
}

void main()
{
    float up = height(waves[0], position.xz) + height(waves[1], position.xz);
    vec3 moved = position + vec3(0.0, up, 0.0);
    vec4 clip = projection * view * model * vec4(moved, 1.0);
    vec4 shade = vec4(vec3(0.2, 0.4, 0.7) + up, 1.0);
    tint = shade;
    gl_Position = clip;
}
