#version 410
const vec4 pl = vec4(1.5, 1.0, -1.0, 1.0);

layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

out vec3 toLight, toEye, n;
void main() {
    vec4 p = mw * pv;
    toLight = (pl * p.w - p * pl.w).xyz;
    toEye = -p.xyz;
    n = (mg * cv).xyz;
    gl_Position = mc * pv;
}
