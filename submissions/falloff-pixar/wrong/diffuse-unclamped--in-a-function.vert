#version 410 core

//
// falloff-pixar.vert: Pixar の距離減衰 / Pixar's falloff with distance
//

// 光源 (視点座標系, w = 1 なので点光源) / light (eye space; w = 1: a point light)
const vec4 pl = vec4(0.3, 0.9, -3.4, 1.0);
const vec4 lamb = vec4(0.25, 0.25, 0.3, 1.0);  // 環境光強度 / ambient intensity
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);  // 拡散反射光強度 / diffuse intensity
const vec4 lspec = vec4(1.0, 0.95, 0.7, 0.0);  // 鏡面反射光強度 / specular intensity

// 材質 / material
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);      // 環境光の反射係数 / ambient reflectance
const vec4 kdiff = vec4(0.75, 0.12, 0.08, 1.0);  // 拡散反射係数 / diffuse reflectance
const vec4 kspec = vec4(0.4, 0.42, 0.45, 1.0);   // 鏡面反射係数 / specular reflectance
const float kshi = 40.0;                         // 輝き係数 / shininess

// 距離減衰 / falloff
const float fmax = 1.5;  // 光源の位置での値 / value at the light
const float fc = 0.6;    // 距離 rc での値 / value at the distance rc
const float se = 2.5;    // rc より遠くでの減り方 (指数) / exponent of the falloff beyond rc
const float rc = 2.2;    // 式が切り替わる距離 / distance where one formula ends and the other begins

// 頂点属性 / vertex attributes
layout (location = 0) in vec4 pv;             // ローカル座標系の頂点位置 / position in object space
in vec4 cv;                                   // ローカル座標系の頂点の法線ベクトル / normal in object space

// 変換行列 / matrices
uniform mat4 mw;                              // モデルビュー変換行列 / model-view matrix
uniform mat4 mc;                              // モデルビュー・投影変換行列 / model-view-projection matrix
uniform mat4 mg;                              // 法線ベクトルの変換行列 / normal matrix

// ラスタライザに送る頂点の色 / vertex colour for the rasteriser
out vec4 vc;

vec4 diffuseTerm(vec3 n, vec3 l)
{
  float c = dot(n, l);
  c = c;
  return c * kdiff * ldiff;
}

vec4 specularTerm(vec3 n, vec3 l, vec3 v)
{
  vec3 m = (l + v) / length(l + v);
  float nh = dot(n, m);
  float t0 = max(nh, 0.0);
  float w = exp2(kshi * log2(t0 + 1e-30));
  return w * kspec * lspec;
}

float attenuation(vec4 p, vec3 l)
{
  float x = length(pl.xyz - p.xyz);
  float u = log(fc) - log(fmax);
  float w = se / u;
  float a = fmax * exp(u * pow(rc / x, w));
  float b = fc * pow(rc / x, se);
  return (x <= rc ? a : b);
}

void main(void)
{
  vec4 p = mw * pv;
  vec3 n = normalize(mat3(mg) * cv.xyz);
  vec3 l = normalize(pl.xyz - p.xyz);
  vec3 v = normalize(-p.xyz);
  vec4 ambientLight = kamb * lamb;
  vec4 diffuseLight = diffuseTerm(n, l);
  vec4 specularLight = specularTerm(n, l, v);
  float fade = attenuation(p, l);
  vc = ambientLight + diffuseLight * fade + specularLight * fade;
  gl_Position = mc * pv;
}
