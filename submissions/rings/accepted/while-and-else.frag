#version 330 core
uniform vec3 iResolution;
uniform float iTime;
out vec4 pixel;
void main()
{
  vec2 p = (gl_FragCoord.xy + gl_FragCoord.xy - iResolution.xy) * (1.0 / iResolution.y);
  if (p.y >= -0.8) {
    float far = length(p), ring = 0.0, light = 1.0;
    while (true) {
      ring += 0.3;
      if (ring > 0.95) break;
      float gap = far < ring ? ring - far : far - ring;
      if (gap < 0.08) light *= smoothstep(0.0, 1.0, gap / 0.08);
    }
    vec3 phase = vec3(0.0, 2.0, 4.0) + far + iTime;
    pixel = vec4(light * (0.5 - 0.5 * sin(phase - 1.5707963267948966)), 1.0);
  } else
    discard;
}
