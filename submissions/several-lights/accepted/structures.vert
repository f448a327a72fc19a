#version 410 core
const vec4 lglob = vec4(0.15, 0.12, 0.1, 1.0);
const vec4 lemi = vec4(0.02, 0.05, 0.09, 0.0);
const vec4 pl1 = vec4(2.0, 1.6, -2.5, 1.0);
const vec4 lamb1 = vec4(0.2, 0.18, 0.14, 0.0);
const vec4 ldiff1 = vec4(1.6, 1.4, 1.1, 0.0);
const vec4 lspec1 = vec4(1.5, 1.3, 1.2, 0.0);
const vec4 pl2 = vec4(-2.2, 0.9, -6.4, 1.0);
const vec4 lamb2 = vec4(0.05, 0.08, 0.11, 0.0);
const vec4 ldiff2 = vec4(0.7, 0.8, 1.9, 0.0);
const vec4 lspec2 = vec4(0.6, 0.9, 1.7, 0.0);
const float sc = 0.3;
const float sl = 0.13;
const float sq = 0.07;
const vec4 kamb = vec4(0.5, 0.11, 0.1, 1.0);
const vec4 kdiff = vec4(0.7, 0.16, 0.12, 1.0);
const vec4 kspec = vec4(0.4, 0.35, 0.3, 1.0);
const float kshi = 16.0;

layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

struct Light { vec4 position, ambient, diffuse, specular; };
struct Point { vec3 p, n, v; };
const Light lights[2] = Light[](Light(pl1, lamb1, ldiff1, lspec1), Light(pl2, lamb2, ldiff2, lspec2));

void shine(const Light light, const Point at, inout vec4 sum)
{
  vec3 to = light.position.xyz / light.position.w - at.p;
  float r2 = dot(to, to), r = sqrt(r2);
  vec3 l = to / r, h = normalize(l + at.v);
  sum += kamb * light.ambient;
  vec4 fading = max(dot(at.n, l), 0.0) * kdiff * light.diffuse;
  fading += pow(max(dot(at.n, h), 0.0), kshi) * kspec * light.specular;
  sum += fading / (sc + sl * r + sq * r2);
}

void main(void)
{
  vec4 p = mw * pv;
  Point at = Point(p.xyz, normalize((mg * cv).xyz), normalize(-p.xyz));
  vec4 sum = lemi + kamb * lglob;
  for (int i = 0; i < lights.length(); ++i) shine(lights[i], at, sum);
  vc = sum;
  gl_Position = mc * pv;
}
