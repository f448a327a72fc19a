#version 330
struct MaterialParam
{
  vec4 ambient;
  vec4 diffuse;
  vec4 specular;
  float shininess;
};

uniform vec3 u_lightPos;
uniform MaterialParam u_lightMaterial;
uniform MaterialParam u_material;

uniform mat4 u_modelMatrix;
uniform mat4 u_viewMatrix;
uniform mat4 u_projectionMatrix;

in vec3 a_position;
in vec3 a_normal;

out vec4 v_color;

struct Vectors { vec3 n, l, v; };

float lobe(in Vectors at, const float exponent)
{
  float d = dot(at.n, at.l);
  if (d < 0.0) return 0.0;
  return pow(max(dot(2.0 * d * at.n - at.l, at.v), 0.0), exponent);
}

void add(inout vec4 sum, float much, vec4 light, vec4 surface) { sum += much * light * surface; }

vec4 lit(MaterialParam light, MaterialParam surface, Vectors at)
{
  vec4 sum = vec4(0.0);
  add(sum, 1.0, light.ambient, surface.ambient);
  add(sum, max(dot(at.n, at.l), 0.0), light.diffuse, surface.diffuse);
  add(sum, lobe(at, surface.shininess), light.specular, surface.specular);
  return sum;
}

void main()
{
  vec4 p = u_viewMatrix * (u_modelMatrix * vec4(a_position, 1.0));
  vec4 l = u_viewMatrix * vec4(u_lightPos, 1.0);
  mat3 g = mat3(u_viewMatrix) * transpose(inverse(mat3(u_modelMatrix)));
  Vectors at = Vectors(normalize(g * a_normal), normalize(vec3(l - p)), -normalize(p.xyz));
  v_color = lit(u_lightMaterial, u_material, at);
  gl_Position = u_projectionMatrix * p;
}
