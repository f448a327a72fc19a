#version 330 core
in vec3 normal;
in vec3 towards[2];
flat in int band;
in vec2 coords;
uniform vec3 lightColor, baseColor;
uniform int mode;
out vec4 FragColor;
const vec3 palette[3] = vec3[](vec3(1.0, 0.3, 0.2), vec3(0.2, 0.9, 0.3), vec3(0.2, 0.4, 1.0));

vec3 surface(vec3 base)
{
  switch (mode) {
  case 0:
    base *= palette[band % 3];
    break;
  case 1:
    base = mix(base, palette[(band + 1) % 3], 0.5);
    break;
  default:
    base = base.gbr;
  }
  return base;
}

void main()
{
  vec3 n = normalize(normal);
  vec3 l = normalize(towards[0]), v = normalize(towards[1]);
  float d = max(dot(n, l), 0.0);
  vec3 sum = surface(baseColor) * (0.15 + d * lightColor);
  // Both waves change along a pixel, and the product of them is no plane in four.
  float height = sin(40.0 * coords.x) * sin(30.0 * coords.y);
  float edge = clamp(8.0 * (abs(dFdx(height)) + abs(dFdy(height))), 0.0, 1.0);
  sum += 0.4 * edge * lightColor;
  sum += 0.3 * lightColor * pow(max(dot(n, normalize(l + v)), 0.0), 20.0);
  FragColor = vec4(sum, 1.0);
}
