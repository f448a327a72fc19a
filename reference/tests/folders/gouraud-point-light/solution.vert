#version 330

// Gouraud shading by a point light, with Phong's reflection vector. All vectors are of eye space.

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
    mat4 mv = u_viewMatrix * u_modelMatrix;
    vec4 p = mv * vec4(a_position, 1.0);
    vec3 n = normalize(transpose(inverse(mat3(mv))) * a_normal);
    vec3 l = normalize((u_viewMatrix * vec4(u_lightPos, 1.0)).xyz - p.xyz);
    vec3 v = -normalize(p.xyz);
    vec3 r = reflect(-l, n);

    float nl = dot(n, l);
    float gate = nl < 0.0 ? 0.0 : 1.0;
    float highlight = gate * pow(max(dot(r, v), 0.0), u_material.shininess);

    vec4 ambient = u_lightMaterial.ambient * u_material.ambient;
    vec4 diffuse = max(nl, 0.0) * u_lightMaterial.diffuse * u_material.diffuse;
    vec4 specular = highlight * u_lightMaterial.specular * u_material.specular;
    vec4 colour = ambient + diffuse + specular;
    vec4 position = u_projectionMatrix * p;

    v_color = colour;
    gl_Position = position;
}
