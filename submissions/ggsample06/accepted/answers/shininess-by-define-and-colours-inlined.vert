#version 410 core
#define kshi 80.0
#define kamb vec4(0.6, 0.0, 0.0, 1.0)
#define kdiff kamb
#define kspec vec4(0.4, 0.4, 0.4, 1.0)
layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main(void)
{
  vec3 v = -normalize((mw * pv).xyz);
  vec3 l = vec3(0.0, 0.0, 1.0);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  vc = kamb * 0.2 + kdiff * max(dot(n, l), 0.0) + kspec * pow(max(dot(n, h), 0.0), kshi);
  gl_Position = mc * pv;
}
