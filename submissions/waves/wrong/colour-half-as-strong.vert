#version 330 core

struct Wave { vec2 direction; float amplitude; float length; };

in vec3 position;
uniform mat4 model, view, projection;
uniform float time;
uniform Wave waves[2];
out vec4 tint;

const float TWO_PI = 6.2831853;

void main()
{
    float y = 0.0;
    for (int i = 0; i < 2; i++) {
        float k = TWO_PI / waves[i].length;
        float phase = dot(waves[i].direction, position.xz) * k + time;
        y += waves[i].amplitude * sin(phase);
    }
    vec3 place = position;
    place.y += y;
    vec3 c = vec3(0.2, 0.4, 0.7);
    c += vec3(0.5 * y);
    tint = vec4(c, 1.0);
    gl_Position = projection * (view * (model * vec4(place, 1.0)));
}
