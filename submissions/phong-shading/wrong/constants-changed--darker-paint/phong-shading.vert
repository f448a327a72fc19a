#version 410 core

//
// phong-shading.vert: フォンシェーディングの頂点シェーダ / Phong shading, vertex shader
//

// 頂点属性 / vertex attributes
layout (location = 0) in vec4 pv;             // ローカル座標系の頂点位置 / position in object space
in vec4 cv;                                   // ローカル座標系の頂点の法線ベクトル / normal in object space

// 変換行列 / matrices
uniform mat4 mw;                              // モデルビュー変換行列 / model-view matrix
uniform mat4 mc;                              // モデルビュー・投影変換行列 / model-view-projection matrix
uniform mat4 mg;                              // 法線ベクトルの変換行列 / normal matrix

// フラグメントシェーダに送るものを, ここで宣言してください (変数名は自由です).
// Declare here what the fragment shader needs (the names are yours).
out vec3 pos;
out vec3 nrm;

void main(void)
{
  pos = (mw * pv).xyz;
  nrm = normalize((mg * cv).xyz);
  gl_Position = mc * pv;
}
