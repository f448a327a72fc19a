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
  float d = NL > 0.0 ? NL : 0.0;
  float s = NL >= 0.0 && RV > 0.0 ? exp(u_material.shininess * log(RV)) : 0.0;
  for (int c = 0; c < 3; c++)
  {
    v_color[c] = u_lightMaterial.ambient[c] * u_material.ambient[c];
    v_color[c] += d * u_lightMaterial.diffuse[c] * u_material.diffuse[c];
    v_color[c] += s * u_lightMaterial.specular[c] * u_material.specular[c];
  }
  v_color.a = 1.0;
  gl_Position = u_projectionMatrix * u_viewMatrix * u_modelMatrix * vec4(a_position, 1.0);
}
