#version 330 core
// As three.js names things: all in eye space.
uniform vec3 ambientLightColor;
uniform vec3 diffuse;
uniform float opacity;
uniform mat4 viewMatrix;
uniform vec3 pointLightPosition;
in vec3 vViewPosition;
in vec3 vNormal;
out vec4 fragColor;
void main()
{
    vec3 n = normalize(vNormal);
    vec3 at = vViewPosition;
    vec3 l = normalize((viewMatrix * vec4(pointLightPosition, 1.0)).xyz - at);
    vec3 v = normalize(-vViewPosition);
    float facing = max(dot(n, l), 0.0);
    float rim = 0.5 * pow(1.0 - max(dot(n, v), 0.0), 3.0);
    vec3 c = diffuse * (ambientLightColor + facing) + rim;
    fragColor = vec4(c * opacity, 1.0);
}
