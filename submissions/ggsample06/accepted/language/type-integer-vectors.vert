#version 410 core
// ivec and uvec arithmetic, converted to float vectors.
in vec4 pv, cv; uniform mat4 mw, mc, mg; out vec4 vc;
void main()
{
  ivec3 tenths = ivec3(6, 0, 0);
  uvec3 fifths = uvec3(1u, 1u, 1u);
  vec3 amb = vec3(tenths) / 10.0 * (vec3(fifths) / 5.0);
  ivec2 pair = ivec2(7, -3) / ivec2(2, 2);        // 3, -1: towards zero
  uvec4 four = uvec4(2u) * uvec4(1, 1, 1, 1);
  vec3 dif = vec3(float(pair.x + pair.y + int(four.w)) * 0.15, ivec2(0));
  vec3 n = normalize(vec3(mg * cv)), e = -normalize(vec3(mw * pv)), l = vec3(ivec3(0, 0, 1));
  vc = vec4(amb + max(dot(n, l), 0.0) * dif + pow(max(dot(n, normalize(l + e)), 0.0), 80.0) * vec3(0.4), 1.0);
  gl_Position = mc * pv;
}
