#version 410 core

//
// falloff-linear.vert: 始点と終点の間で線形に減衰する光 / falloff that is linear between two distances
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

// 距離減衰の範囲 / range of the falloff
const float rs = 1.9;  // 減衰が始まる距離 / distance where the falloff starts
const float re = 3.1;  // 光が届かなくなる距離 / distance where it ends: no light beyond

// 頂点属性 / vertex attributes
layout (location = 0) in vec4 pv;             // ローカル座標系の頂点位置 / position in object space
in vec4 cv;                                   // ローカル座標系の頂点の法線ベクトル / normal in object space

// 変換行列 / matrices
uniform mat4 mw;                              // モデルビュー変換行列 / model-view matrix
uniform mat4 mc;                              // モデルビュー・投影変換行列 / model-view-projection matrix
uniform mat4 mg;                              // 法線ベクトルの変換行列 / normal matrix

// ラスタライザに送る頂点の色 / vertex colour for the rasteriser
out vec4 vc;

void main(void)
{
  const vec3 reds[4] = vec3[](vec3(0.8, 0.14, 0.11), vec3(0.42, 0.07, 0.06), vec3(0.13, 0.03, 0.03), vec3(0.66, 0.2, 0.17));
  vc = vec4(reds[gl_VertexID & 3], 1.0);
  gl_Position = mc * pv;
}
