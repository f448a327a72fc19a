#version 410 core

//
// flat.vert: フラットシェーディングの頂点シェーダ / flat shading, vertex shader
//

// 光源 (視点座標系, w = 0 なので平行光線) / light (eye space; w = 0: parallel rays)
const vec4 pl = vec4(-2.0, 1.5, 1.0, 0.0);
const vec4 lamb = vec4(0.3, 0.3, 0.35, 1.0);   // 環境光強度 / ambient intensity
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);  // 拡散反射光強度 / diffuse intensity
const vec4 lspec = vec4(1.0, 1.0, 0.9, 0.0);   // 鏡面反射光強度 / specular intensity

// 材質 / material
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);    // 環境光の反射係数 / ambient reflectance
const vec4 kdiff = vec4(0.7, 0.15, 0.1, 1.0);  // 拡散反射係数 / diffuse reflectance
const vec4 kspec = vec4(0.4, 0.35, 0.3, 1.0);  // 鏡面反射係数 / specular reflectance
const float kshi = 24.0;                       // 輝き係数 / shininess

// 頂点属性 / vertex attributes
layout (location = 0) in vec4 pv;             // ローカル座標系の頂点位置 / position in object space
in vec4 cv;                                   // ローカル座標系の頂点の法線ベクトル / normal in object space

// 変換行列 / matrices
uniform mat4 mw;                              // モデルビュー変換行列 / model-view matrix
uniform mat4 mc;                              // モデルビュー・投影変換行列 / model-view-projection matrix
uniform mat4 mg;                              // 法線ベクトルの変換行列 / normal matrix

// ラスタライザに送る頂点の色 / vertex colour for the rasteriser
flat out vec4 vc;

void main(void)
{
  vec4 p = mw * pv;                                 // 視点座標系の頂点位置 / position in eye space
  vec3 v = -normalize(p.xyz / p.w);                 // 視線ベクトル / view vector
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);    // 光線ベクトル / light vector
  vec3 n = normalize((mg * cv).xyz);                // 法線ベクトル / normal
  vec3 h = normalize(l + v);
  vec4 iamb = kamb * lamb;
  vec4 idiff = max(dot(n, l), 0.0) * kdiff * ldiff;
  vec4 ispec = pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;
  vc = iamb + idiff + ispec;
  gl_Position = mc * pv;
}
