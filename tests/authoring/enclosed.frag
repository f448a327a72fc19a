#version 330 core
uniform vec3 lightPos, objectColor, ambient;
in vec3 FragPos, Normal;
out vec4 FragColor;

float falloff(float d) {
    // ggrade: begin
    float near = 1.0 + 0.2 * d;
    // ggrade: end
    return 1.0 / (near * near);
}

vec3 shade(vec3 n) {
    // ggrade: begin
    vec3 toLight = lightPos - FragPos;
    float d = length(toLight);
    return objectColor * falloff(d) * max(dot(n, toLight / d), 0.0);
    // ggrade: end
}

void base(out vec3 colour) {
    // ggrade: begin
    colour = ambient * objectColor;
    // ggrade: end
}

void main() {
    // ggrade: begin
    vec3 own;
    base(own);
    FragColor = vec4(own + shade(normalize(Normal)), 1.0);
    // ggrade: end
}
