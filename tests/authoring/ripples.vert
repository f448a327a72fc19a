#version 330 core
in vec3 aPos;
uniform mat4 model, view, projection;
uniform float time;
uniform float amplitude;
uniform vec2 direction;
uniform float wavelength;
out vec3 vNormal;
out vec3 vColor;
void main() {
    float k = 6.2831853 / wavelength;
    float phase = k * dot(normalize(direction), aPos.xz) + time;
    vec3 p = aPos;
    p.y += amplitude * sin(phase);
    vec2 slope = amplitude * k * cos(phase) * normalize(direction);
    vNormal = normalize(vec3(-slope.x, 1.0, -slope.y));
    vColor = vec3(0.1, 0.3, 0.6) + 0.5 * p.y;
    gl_Position = projection * view * model * vec4(p, 1.0);
}
