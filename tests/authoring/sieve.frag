#version 430 core
uniform vec3 lightColor;
struct Surface { vec3 at, normal; };
in Surface surface;
in ToLamp { vec3 way; noperspective vec2 screen; } from[2];
in vec2 coordinates;
out vec4 FragColor;
void main()
{
    vec2 cell = fract(coordinates * 5.0) - 0.5;
    if (dot(cell, cell) < 0.1) discard;
    vec3 n = normalize(surface.normal) * (gl_FrontFacing ? 1.0 : -1.0);
    vec3 sum = vec3(0.1);
    for (int i = 0; i < 2; i++) sum += 0.6 * lightColor * max(dot(n, normalize(from[i].way)), 0.0);
    FragColor = vec4(sum * (1.0 - 0.3 * dot(from[1].screen, from[1].screen)), 1.0);
}
