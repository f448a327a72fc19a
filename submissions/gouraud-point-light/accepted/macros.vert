#version 330
#define SATURATE(x) clamp(x, 0.0, 1.0)
#define MUL(m) (u_lightMaterial.m * u_material.m)
#define TO_EYE(m, p) ((m) * vec4(p, 1.0)).xyz
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

#ifndef GATE
#define GATE(x) step(0.0, x)
#endif
void main()
{
  mat4 mv = u_viewMatrix * u_modelMatrix;
  vec3 p = TO_EYE(mv, a_position), q = TO_EYE(u_viewMatrix, u_lightPos);
  vec3 n = normalize(inverse(transpose(mat3(mv))) * a_normal), l = normalize(q - p);
  float nl = dot(n, l);
  v_color = MUL(ambient) + SATURATE(nl) * MUL(diffuse)
          + GATE(nl) * pow(SATURATE(dot(reflect(-l, n), -normalize(p))), u_material.shininess) * MUL(specular);
  gl_Position = u_projectionMatrix * vec4(p, 1.0);
}
