#version 410 core

//
// several-lights.vert: 複数の光源 / several lights
//

// 光源によらない光 / light of no light source
const vec4 lglob = vec4(0.15, 0.12, 0.1, 1.0);    // 大域的な環境光強度 / global ambient intensity
const vec4 lemi = vec4(0.02, 0.05, 0.09, 0.0);    // 面からの放射光強度 / intensity that the surface emits

// 光源 1 (視点座標系, w = 1 なので点光源) / light 1 (eye space; w = 1: a point)
const vec4 pl1 = vec4(2.0, 1.6, -2.5, 1.0);
const vec4 lamb1 = vec4(0.2, 0.18, 0.14, 0.0);    // 環境光強度 / ambient intensity
const vec4 ldiff1 = vec4(1.6, 1.4, 1.1, 0.0);     // 拡散反射光強度 / diffuse intensity
const vec4 lspec1 = vec4(1.5, 1.3, 1.2, 0.0);     // 鏡面反射光強度 / specular intensity

// 光源 2 / light 2
const vec4 pl2 = vec4(-2.2, 0.9, -6.4, 1.0);
const vec4 lamb2 = vec4(0.05, 0.08, 0.11, 0.0);   // 環境光強度 / ambient intensity
const vec4 ldiff2 = vec4(0.7, 0.8, 1.9, 0.0);     // 拡散反射光強度 / diffuse intensity
const vec4 lspec2 = vec4(0.6, 0.9, 1.7, 0.0);     // 鏡面反射光強度 / specular intensity

// 距離による減衰の係数 (どちらの光源にも使う) / coefficients of the falloff (of both lights)
const float sc = 0.3;                             // 定数項 / constant
const float sl = 0.13;                            // 1 次の係数 / linear
const float sq = 0.07;                            // 2 次の係数 / quadratic

// 材質 / material
const vec4 kamb = vec4(0.5, 0.11, 0.1, 1.0);      // 環境光の反射係数 / ambient reflectance
const vec4 kdiff = vec4(0.7, 0.16, 0.12, 1.0);    // 拡散反射係数 / diffuse reflectance
const vec4 kspec = vec4(0.4, 0.35, 0.3, 1.0);     // 鏡面反射係数 / specular reflectance
const float kshi = 16.0;                          // 輝き係数 / shininess

// 頂点属性 / vertex attributes
layout (location = 0) in vec4 pv;                 // ローカル座標系の頂点位置 / position in object space
in vec4 cv;                                       // ローカル座標系の頂点の法線ベクトル / normal in object space

// 変換行列 / matrices
uniform mat4 mw;                                  // モデルビュー変換行列 / model-view matrix
uniform mat4 mc;                                  // モデルビュー・投影変換行列 / model-view-projection matrix
uniform mat4 mg;                                  // 法線ベクトルの変換行列 / normal matrix

// ラスタライザに送る頂点の色 / vertex colour for the rasteriser
out vec4 vc;

void main(void)
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 n = normalize((mg * cv).xyz);

  vc = kamb * lglob + lemi;                       // 光源はこれから / the lights are still to come
  gl_Position = mc * pv;
}
