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

// 点 P, 法線 N の色を求める
vec4 shade(vec3 P, vec3 N, vec3 lightPos)
{
  vec3 toLight = normalize(lightPos - P);
  vec3 toEye = -normalize(P);
  float cosine = dot(N, toLight);

  vec4 color = u_lightMaterial.ambient * u_material.ambient;
  color += u_lightMaterial.diffuse * u_material.diffuse * max(0.0, cosine);
  if (cosine >= 0.0)
  {
    vec3 mirror = 2.0 * cosine * N + toLight;
    float k = pow(max(0.0, dot(mirror, toEye)), u_material.shininess);
    color += u_lightMaterial.specular * u_material.specular * k;
  }
  return color;
}

void main()
{
  mat4 mv = u_viewMatrix * u_modelMatrix;
  mat3 normalMatrix = transpose(inverse(mat3(mv)));
  vec4 eyePosition = mv * vec4(a_position, 1);
  vec4 eyeLight = u_viewMatrix * vec4(u_lightPos, 1);

  v_color = shade(eyePosition.xyz, normalize(normalMatrix * a_normal), eyeLight.xyz);
  gl_Position = u_projectionMatrix * eyePosition;
}
