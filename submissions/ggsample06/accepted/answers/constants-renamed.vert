#version 410 core

const vec3 LIGHT_DIRECTION = vec3(0.0, 0.0, 1.0);
const vec3 AMBIENT_LIGHT = vec3(0.2);
const vec3 DIFFUSE_LIGHT = vec3(1.0);
const vec3 SPECULAR_LIGHT = vec3(1.0);
const vec3 MATERIAL_AMBIENT = vec3(0.6, 0.0, 0.0);
const vec3 MATERIAL_DIFFUSE = vec3(0.6, 0.0, 0.0);
const vec3 MATERIAL_SPECULAR = vec3(0.4);
const float SHININESS = 80.0;

in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

void main()
{
    vec3 toEye = normalize(-(mw * pv).xyz);
    vec3 normal = normalize((mg * cv).xyz);
    vec3 halfway = normalize(LIGHT_DIRECTION + toEye);
    vec3 color = MATERIAL_AMBIENT * AMBIENT_LIGHT;
    color += MATERIAL_DIFFUSE * DIFFUSE_LIGHT * max(dot(normal, LIGHT_DIRECTION), 0.0);
    color += MATERIAL_SPECULAR * SPECULAR_LIGHT * pow(max(dot(normal, halfway), 0.0), SHININESS);
    vc = vec4(color, 1.0);
    gl_Position = mc * pv;
}
