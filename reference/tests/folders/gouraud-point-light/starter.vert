#version 330

struct MaterialParam {
    vec4 ambient;
    vec4 diffuse;
    vec4 specular;
    float shininess;
};

in vec3 a_position;
in vec3 a_normal;

uniform mat4 u_modelMatrix;
uniform mat4 u_viewMatrix;
uniform mat4 u_projectionMatrix;
uniform vec3 u_lightPos;
uniform MaterialParam u_lightMaterial;
uniform MaterialParam u_material;

out vec4 v_color;

void main()
{
    v_color = vec4(a_normal, 1.0);
    gl_Position = u_projectionMatrix * u_viewMatrix * u_modelMatrix * vec4(a_position, 1.0);
}
