#version 330 core
in vec2 uv;
in vec3 normal;
out vec4 color;
uniform sampler2D noiseTex;
uniform float threshold;
uniform vec3 topColor;
uniform vec3 lightDir;
uniform float translucency;
void main() {
    if (texture(noiseTex, uv).r < threshold) discard;
    vec3 n = normalize(normal);
    vec3 c = topColor;
    if (!gl_FrontFacing) {
        n = -n;
        c = vec3(0.9, 0.8, 0.3);
    }
    float lit = max(dot(n, normalize(lightDir)), 0.0);
    // Beyond what the values reach.
    lit = min(lit + 0.1 * translucency, 1.5);
    color = vec4(c * (0.2 + 0.5 * lit), 1.0);
}
