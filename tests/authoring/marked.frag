#version 330 core
uniform vec3 lightPos, viewPos, objectColor;
uniform float shininess = 24.0;
in vec3 FragPos, Normal;
out vec4 FragColor;
void main() {
    vec3 n = normalize(Normal);
    vec3 l = normalize(lightPos - FragPos);
    vec3 v = normalize(viewPos - FragPos);
    // ggrade: begin
    vec3 h = normalize(l + v);
    float diffuse = max(dot(n, l), 0.0);
    float specular = pow(max(dot(n, h), 0.0), shininess);
    // ggrade: end
    vec3 c = objectColor * (0.1 + 0.6 * diffuse) + vec3(0.4) * specular;
    FragColor = vec4(c, 1.0);
}
