#version 330 core
in vec3 aPos, aNormal;
uniform mat4 model, view, projection;
uniform vec3 lightPos, viewPos;
out float sum;
void main()
{
  vec4 world = model * vec4(aPos, 1.0);
    vec3 n = normalize(mat3(transpose(inverse(model))) * aNormal), l = normalize(lightPos - world.xyz), v = normalize(viewPos - world.xyz);
  sum = 0.1 + max(dot(n, l), 0.0) + 0.5 * pow(max(dot(v, reflect(-l, n)), 0.0), 32.0);
  gl_Position = projection * view * world;
}
