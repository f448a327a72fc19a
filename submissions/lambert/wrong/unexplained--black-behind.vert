#version 410 core

//
// lambert.vert: ランバートの余弦則 / Lambert's law
//

// 光源 (視点座標系, w = 0 なので平行光線) / light (eye space; w = 0: parallel rays)
const vec4 pl = vec4(1.5, 0.5, 2.0, 0.0);
const vec4 lamb = vec4(0.25, 0.25, 0.3, 1.0);    // 環境光強度 / ambient intensity
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);    // 拡散反射光強度 / diffuse intensity

// 材質 / material
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);      // 環境光の反射係数 / ambient reflectance
const vec4 kdiff = vec4(0.75, 0.12, 0.08, 1.0);  // 拡散反射係数 / diffuse reflectance

// 頂点属性 / vertex attributes
layout (location = 0) in vec4 pv;                // ローカル座標系の頂点位置 / position in object space
in vec4 cv;                                      // ローカル座標系の頂点の法線ベクトル / normal in object space

// 変換行列 / matrices
uniform mat4 mw;                                 // モデルビュー変換行列 / model-view matrix
uniform mat4 mc;                                 // モデルビュー・投影変換行列 / model-view-projection matrix
uniform mat4 mg;                                 // 法線ベクトルの変換行列 / normal matrix

// ラスタライザに送る頂点の色 / vertex colour for the rasteriser
out vec4 vc;

void main(void)
{
  gl_Position = mc * pv;
  vec3 normal = normalize((mg * cv).xyz);
  vec3 light = normalize(pl.xyz);
  float c = dot(normal, light);
  if (c <= 0.0)
  {
    vc = vec4(0.0);
    return;
  }
  vc = kamb * lamb + c * kdiff * ldiff;
}
