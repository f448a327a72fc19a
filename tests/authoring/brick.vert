#version 410 core
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_texcoord;
layout(location = 3) in vec4 a_tangent;
uniform mat4 u_model;
uniform mat4 u_view;
uniform mat4 u_projection;
uniform mat3 u_normalMatrix;
out Frame {
    vec3 position;
    vec2 uv;
    mat3 tbn;
} vs_out;
void main()
{
    vec4 world = u_model * vec4(a_position, 1.0);
    vec3 n = normalize(u_normalMatrix * a_normal);
    vec3 t = normalize(mat3(u_model) * a_tangent.xyz);
    vs_out.position = world.xyz;
    vs_out.uv = 2.0 * a_texcoord;
    vs_out.tbn = mat3(t, cross(n, t) * a_tangent.w, n);
    gl_Position = u_projection * u_view * world;
}
