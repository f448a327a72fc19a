#version 410 core
// A shorter vector from a longer one, dropping components: vec3(vec4), vec2(vec3), float(vec4), int(vec2).
// 光源と材質
const vec4 pl    = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb  = vec4(vec3(0.2), 1.0);
const vec4 ldiff = vec4(vec3(1.0), 0.0);
const vec4 lspec = vec4(vec3(1.0), 0.0);
const vec4 kamb  = vec4(0.6, vec2(0.0), 1.0);
const vec4 kdiff = vec4(0.6, vec2(0.0), 1.0);
const vec4 kspec = vec4(vec3(0.4), 1.0);
const float kshi = 80.0;
// 頂点属性
layout (location = 0) in vec4 pv;
in vec4 cv;

// 変換行列
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

// 頂点色
out vec4 vc;
void main(void)
{
  vec4 p = mw * pv;
  vec3 v = -normalize(vec3(p) / p.w);
  vec3 l = normalize(vec3(pl * p.w - p * pl.w));
  vec3 n = normalize(vec3(mg * cv));
  vec2 lit = vec2(vec3(max(dot(n, l), 0.0), pow(max(dot(n, normalize(l + v)), 0.0), kshi), 17.0));
  float first = float(lit);
  int one = int(vec2(1.75, 9.0));
  vc = kamb * lamb * one + first * kdiff * ldiff + lit.y * kspec * lspec;
  gl_Position = mc * pv;
}
