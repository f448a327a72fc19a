#version 330 core
uniform vec3 iResolution;
uniform float iTime;
out vec4 pixel;

void mainImage(out vec4 colour, in vec2 at)
{
  colour = vec4(at / iResolution.xy, 0.0, 1.0);
}

void main() { mainImage(pixel, gl_FragCoord.xy); }
