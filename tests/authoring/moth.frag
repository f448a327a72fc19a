#version 330 core
in vec2 uv;
in vec3 normal;
out vec4 color;
uniform sampler2D noiseTex;
uniform float threshold;
uniform float edgeWidth;
uniform vec3 edgeColor;
uniform vec3 baseColor;
uniform vec3 lightDir;
void main() {
    float n = texture(noiseTex, uv).r;
    if (n < threshold) discard;
    vec3 c = baseColor * (0.3 + 0.7 * max(dot(normalize(normal), normalize(lightDir)), 0.0));
    float e = 1.0 - smoothstep(threshold, threshold + edgeWidth, n);
    c += edgeColor * e;
    color = vec4(c, 1.0);
}
