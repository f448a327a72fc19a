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

void main()
{
  mat4 mv = u_viewMatrix * u_modelMatrix;
  vec4 p = mv * vec4(a_position, 1.0);
  vec3 n = normalize(transpose(inverse(mat3(mv))) * a_normal);
  vec3 l = normalize((u_viewMatrix * vec4(u_lightPos, 1.0)).xyz - p.xyz);
  vec3 v = -normalize(p.xyz);
  float nl = dot(n, l);
  vec4 terms[3];
  terms[0] = u_lightMaterial.ambient * u_material.ambient;
  terms[1] = max(nl, 0) * u_lightMaterial.diffuse * u_material.diffuse;
  terms[2] = vec4(0);
  if (!(nl < 0))
    terms[2] = pow(max(dot(reflect(l, n), -v), 0), u_material.shininess) * u_lightMaterial.specular * u_material.specular;
  v_color = vec4(0);
  for (int i = 0; i < 3; ++i)
    v_color += terms[i];
  gl_Position = u_projectionMatrix * p;
}
