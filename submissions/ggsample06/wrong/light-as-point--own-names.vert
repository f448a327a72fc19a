#version 410 core

// light
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);     // position
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);   // ambient
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);  // diffuse
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);  // specular

// material
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;

layout (location = 0) in vec4 pv;  // position
in vec4 cv;                        // normal

uniform mat4 mw;  // model-view
uniform mat4 mc;  // model-view-projection
uniform mat4 mg;  // normal matrix

out vec4 vc;

void main()
{
    vec3 position = vec3(mw * pv);
    vec3 normal = normalize(vec3(mg * cv));
    vec3 toLight = normalize(vec3(pl) - position);
    vec3 toEye = normalize(-position);
    vec3 halfway = normalize(toLight + toEye);

    vec4 color = kamb * lamb;
    color += kdiff * ldiff * max(dot(normal, toLight), 0.0);
    color += kspec * lspec * pow(max(dot(normal, halfway), 0.0), kshi);

    vc = color;
    gl_Position = mc * pv;
}
