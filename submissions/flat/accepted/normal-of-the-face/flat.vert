#version 410

layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

out vec4 eyePoint;
flat out vec3 eyeNormal;
void main() {
    eyePoint = mw * pv;
    eyeNormal = (mg * cv).xyz;
    gl_Position = mc * pv;
}
