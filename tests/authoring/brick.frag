#version 410 core
in Frame {
    vec3 position;
    vec2 uv;
    mat3 tbn;
} fs_in;
uniform sampler2D u_albedo;
uniform sampler2D u_normalMap;
uniform vec3 u_lightPos;
uniform vec3 u_cameraPos;
layout(location = 0) out vec4 o_color;
void main()
{
    vec3 n = normalize(fs_in.tbn * (2.0 * texture(u_normalMap, fs_in.uv).xyz - 1.0));
    vec3 l = normalize(u_lightPos - fs_in.position);
    vec3 v = normalize(u_cameraPos - fs_in.position);
    vec3 albedo = texture(u_albedo, fs_in.uv).rgb;
    vec3 diffuse = albedo * max(dot(n, l), 0.0);
    vec3 specular = vec3(0.4) * pow(max(dot(n, normalize(l + v)), 0.0), 20.0);
    o_color = vec4(0.1 * albedo + diffuse + specular, 1.0);
}
