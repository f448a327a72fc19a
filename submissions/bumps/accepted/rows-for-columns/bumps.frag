#version 330 core
in mat3 toSurface;
in vec3 toLight;
in vec4 st;
uniform sampler2D paint, relief;
out vec4 colour;
void main()
{
  vec3 texel = texture(relief, st.zw).rgb * 2.0 - vec3(1.0);
  vec3 n = texel * toSurface;
  float cosine = dot(normalize(toLight), n / length(n));
  colour = vec4(texture(paint, st.xy).rgb * (0.2 + max(0.8 * cosine, 0.0)), 1.0);
}
