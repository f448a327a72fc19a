#version 430 core
layout(location = 0) in vec3 aPos;
layout(location = 1) in vec3 aNormal;
layout(location = 2) in vec2 aTexCoords;
uniform mat4 model, view, projection;
uniform mat3 normalMatrix;
uniform vec3 lightPos[2];
struct Surface { vec3 at, normal; };
out Surface surface;
out ToLamp { vec3 way; noperspective vec2 screen; } lamp[2];
out vec2 coordinates;
void main()
{
    vec4 world = model * vec4(aPos, 1.0);
    surface = Surface(world.xyz, normalMatrix * aNormal);
    coordinates = aTexCoords;
    gl_Position = projection * view * world;
    for (int i = 0; i < 2; i++) {
        lamp[i].way = lightPos[i] - world.xyz;
        lamp[i].screen = gl_Position.xy / gl_Position.w;
    }
}
