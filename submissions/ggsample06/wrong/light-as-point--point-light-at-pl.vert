#version 410 core

// 光源の位置と強さ
const vec4 pl    = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb  = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);

// 材質の反射係数
const vec4 kamb  = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;

// 頂点属性
in vec4 pv;   // 位置
in vec4 cv;   // 法線

// 変換行列
uniform mat4 mw;   // モデルビュー変換
uniform mat4 mc;   // モデルビュー・投影変換
uniform mat4 mg;   // 法線変換

// フラグメントシェーダに渡す色
out vec4 vc;

void main(void)
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize(pl.xyz - p.xyz);   // 光源への向き
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  vec4 iamb = kamb * lamb;
  vec4 idiff = max(dot(n, l), 0) * kdiff * ldiff;
  vec4 ispec = pow(max(dot(n, h), 0), kshi) * kspec * lspec;
  vc = iamb + idiff + ispec;
  gl_Position = mc * pv;
}
