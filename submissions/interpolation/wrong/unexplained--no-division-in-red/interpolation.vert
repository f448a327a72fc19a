#version 410 core

//
// interpolation.vert: 補間の方法の指定 (頂点シェーダ) / interpolation qualifiers, vertex shader
//

// 頂点属性 / vertex attributes
layout (location = 0) in vec4 pv;             // ローカル座標系の頂点位置 / position in object space
in vec2 tv;                                   // テクスチャ座標 / texture coordinates

// 変換行列 / matrix
uniform mat4 mc;                              // モデルビュー・投影変換行列 / model-view-projection matrix

// テクスチャ座標の x 成分を, 3 通りの補間でフラグメントシェーダに送ります.
// そのための変数を, ここで宣言してください (変数名は自由です).
// The x component of the texture coordinates goes to the fragment shader, interpolated in three ways.
// Declare the variables for it here (the names are yours).

noperspective out vec3 q;
flat out vec2 corner;

void main(void)
{
  gl_Position = mc * pv;
  float iw = 1.0 / gl_Position.w;
  q = vec3(tv.x * iw, iw, tv.x);
  corner = tv;
}
