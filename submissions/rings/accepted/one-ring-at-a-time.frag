#version 410
layout (location = 0) out vec4 result;
uniform vec3 iResolution; uniform float iTime;
vec3 faded(vec3 tint, float far, float ring)
{
  return ring >= 1.0 ? tint : tint * smoothstep(0.0, 0.08, max(far - ring, ring - far));
}
void mainImage(out vec4 colour, vec2 at)
{
  float aspect = iResolution.x / iResolution.y;
  vec2 uv = at / iResolution.xy;
  vec2 p = vec2(aspect, 1.0) * (uv + uv - 1.0);
  float far = sqrt(dot(p, p));
  vec3 angle = vec3(far, far + 2.0, far + 4.0) + vec3(iTime);
  // (1 + cos a) / 2 is the square of cos(a / 2).
  vec3 tint = pow(abs(cos(0.5 * angle)), vec3(2.0));
  tint = faded(faded(faded(tint, far, 0.9), far, 0.6), far, 0.3);
  colour = vec4(tint, p.y);
}
void main()
{
  vec4 image;
  mainImage(image, gl_FragCoord.xy);
  if (image.a < -0.8) discard;
  result = vec4(image.rgb, 1.0);
}
