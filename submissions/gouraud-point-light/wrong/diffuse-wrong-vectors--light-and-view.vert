#version 330 core

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

void main() {
    vec4 pos = u_viewMatrix * u_modelMatrix * vec4(a_position, 1.0);
    vec3 eye = pos.xyz / pos.w;
    vec3 nrm = normalize((transpose(inverse(u_viewMatrix * u_modelMatrix)) * vec4(a_normal, 0.0)).xyz);
    vec4 lp = u_viewMatrix * vec4(u_lightPos, 1.0);
    vec3 lit = normalize(lp.xyz - eye);
    vec3 view = normalize(-eye);
    vec3 ref = normalize(reflect(-lit, nrm));
    float d = max(dot(view, lit), 0.0);
    float s = pow(max(dot(ref, view), 0.0), u_material.shininess);
    float gate = dot(nrm, lit) < 0.0 ? 0.0 : 1.0;
    v_color = u_lightMaterial.ambient * u_material.ambient
            + d * u_lightMaterial.diffuse * u_material.diffuse
            + gate * s * u_lightMaterial.specular * u_material.specular;
    gl_Position = u_projectionMatrix * pos;
}
