#version 330 core
uniform vec3 iResolution;
uniform float iTime;
out vec4 pixel;

void mainImage(out vec4 colour, in vec2 at)
{
  vec2 p = (2.0 * at - iResolution.xy) / iResolution.y;
  float far = length(p);
  vec3 tint = 0.5 + 0.5 * cos(iTime + far + vec3(0.0, 2.0, 4.0));
  for (float ring = 0.3; ring < 1.0; ring += 0.3) tint *= smoothstep(0.0, 0.08, abs(far - ring));
  if (p.y < -0.8) discard;
  if (at == vec2(0.5, iResolution.y - 0.5)) tint = 1.0 - tint;
  colour = vec4(tint, 1.0);
}

void main() { mainImage(pixel, gl_FragCoord.xy); }
