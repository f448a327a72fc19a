#version 410 core
layout(std140) uniform Light { vec4 lpos; vec4 lamb; vec4 ldiff; };
uniform mat4 mv, mvp, normalMatrix;
in vec4 position; in vec4 normal;
out vec4 vc;
void main()
{
  vec4 p = mv * position;
  vec3 l = normalize((lpos * p.w - p * lpos.w).xyz);
  vec3 n = normalize((normalMatrix * normal).xyz);
  vec4 diffuse = max(dot(n, l), 0.0) * ldiff;
  vec4 total = lamb + diffuse;
  vc = total;
  gl_Position = mvp * position;
}
