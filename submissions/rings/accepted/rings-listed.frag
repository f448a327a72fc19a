#version 330 core
uniform float iTime;
uniform vec3 iResolution;
out vec4 pixel;
const float rings[3] = float[3](0.3, 0.6, 0.9);
void main()
{
  if (2.0 * gl_FragCoord.y < 0.2 * iResolution.y) discard;
  vec2 middle = 0.5 * iResolution.xy;
  float far = 2.0 * distance(gl_FragCoord.xy, middle) / iResolution.y;
  float dark = 1.0;
  for (int i = 0; i < rings.length(); i++) {
    float x = clamp(abs(far - rings[i]) / 0.08, 0.0, 1.0);
    dark *= (3.0 - 2.0 * x) * x * x;
  }
  pixel.r = cos(far + iTime);
  pixel.g = cos(far + 2.0 + iTime);
  pixel.b = cos(far + 4.0 + iTime);
  pixel = vec4(dark * (pixel.rgb + 1.0) / 2.0, 1.0);
}
