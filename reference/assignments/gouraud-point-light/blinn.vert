#version 330

// Right as well: Blinn's half vector (slides 20 and 21) in place of the reflected one. It has all names of solution.vert,
// also r, which it does not need, so that mistakes are looked for beside it too.

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
    // The point and the light, where the eye is the origin.
    mat4 mv = u_viewMatrix * u_modelMatrix;
    vec3 p = (mv * vec4(a_position, 1.0)).xyz;
    vec3 light = (u_viewMatrix * vec4(u_lightPos, 1.0)).xyz;

    // Vectors of length 1: to the eye, to the light, of the surface, and half way between the first two.
    vec3 v = normalize(-p);
    vec3 l = normalize(light - p);
    vec3 n = normalize(transpose(inverse(mat3(mv))) * a_normal);
    vec3 r = reflect(-l, n);
    vec3 h = normalize(l + v);

    // No light from behind the surface.
    float nl = dot(n, l);
    float lambert = max(nl, 0.0);
    float rv = dot(n, h);
    float facing = max(rv, 0.0);
    float mirrored = pow(facing, u_material.shininess);
    float highlight = nl < 0.0 ? 0.0 : mirrored;

    // The three terms.
    vec4 ambient = u_lightMaterial.ambient * u_material.ambient;
    vec4 diffuse = lambert * u_lightMaterial.diffuse * u_material.diffuse;
    vec4 specular = highlight * u_lightMaterial.specular * u_material.specular;
    vec4 total = ambient + diffuse + specular;

    // What is written out.
    vec4 colour = total;
    vec4 position = u_projectionMatrix * u_viewMatrix * u_modelMatrix * vec4(a_position, 1.0);
    v_color = colour;
    gl_Position = position;
}
