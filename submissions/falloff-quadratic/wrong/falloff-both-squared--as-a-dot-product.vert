#version 460 core

//
// falloff-quadratic.vert: 距離の 2 次式による減衰 / falloff by a quadratic function of the distance
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

// 距離減衰の係数 / coefficients of the falloff
const float sc = 0.2;   // 定数項 / constant term
const float sl = 0.15;  // 距離の 1 次の項 / times the distance
const float sq = 0.1;   // 距離の 2 次の項 / times its square

// 頂点属性 / vertex attributes
layout (location = 0) in vec4 pv;             // ローカル座標系の頂点位置 / position in object space
in vec4 cv;                                   // ローカル座標系の頂点の法線ベクトル / normal in object space

// 変換行列 / matrices
uniform mat4 mw;                              // モデルビュー変換行列 / model-view matrix
uniform mat4 mc;                              // モデルビュー・投影変換行列 / model-view-projection matrix
uniform mat4 mg;                              // 法線ベクトルの変換行列 / normal matrix

// ラスタライザに送る頂点の色 / vertex colour for the rasteriser
out vec4 vc;

#define POS(x) ((x) > 0.0 ? (x) : 0.0)

void main(void)
{
  vec4 p = mw * pv;                                 // 視点座標系の頂点位置 / position in eye space
  vec3 v = -normalize(p.xyz / p.w);                 // 視線ベクトル / view vector
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);    // 光線ベクトル / light vector
  vec3 n = normalize((mg * cv).xyz);                // 法線ベクトル / normal
  vec3 hv = normalize(v + l);
  float spec = pow(clamp(dot(hv, n), 0.0, 1.0), kshi);
  float len = length(pl.xyz - p.xyz / p.w);
  float d = 1.0 / dot(vec3(sc, sl, sq), vec3(1.0, len * len, len * len));
  vc = kamb * lamb
     + d * (POS(dot(l, n)) * ldiff * kdiff
          + spec * lspec * kspec);

  gl_Position = mc * pv;
}
