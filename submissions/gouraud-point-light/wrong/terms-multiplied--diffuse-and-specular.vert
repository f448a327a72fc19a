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

void main(void)
{
  mat4 modelView = u_viewMatrix * u_modelMatrix;
  vec3 P = (modelView * vec4(a_position, 1.0)).xyz;
  vec3 N = normalize(transpose(inverse(mat3(modelView))) * a_normal);
  vec3 lightEye = (u_viewMatrix * vec4(u_lightPos, 1.0)).xyz;
  vec3 L = normalize(lightEye - P);
  vec3 V = normalize(-P);
  vec3 R = reflect(-L, N);

  float NL = dot(N, L);
  float RV = dot(R, V);
  vec4 ambient = u_lightMaterial.ambient * u_material.ambient;
  vec4 diffuse = max(NL, 0.0) * u_lightMaterial.diffuse * u_material.diffuse;
  vec4 specular = pow(max(RV, 0.0), u_material.shininess) * u_lightMaterial.specular * u_material.specular;
  if (NL < 0.0) specular = vec4(0.0);

  v_color = ambient + diffuse * specular;
  gl_Position = u_projectionMatrix * u_viewMatrix * u_modelMatrix * vec4(a_position, 1.0);
}
