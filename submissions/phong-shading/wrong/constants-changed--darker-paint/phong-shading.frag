#version 410 core

//
// phong-shading.frag: フォンシェーディングのフラグメントシェーダ / Phong shading, fragment shader
//

// 光源 (視点座標系, w = 1 なので点光源) / light (eye space; w = 1: a point)
const vec4 pl = vec4(1.5, 1.0, -1.0, 1.0);
const vec4 lamb = vec4(0.3, 0.3, 0.35, 1.0);   // 環境光強度 / ambient intensity
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);  // 拡散反射光強度 / diffuse intensity
const vec4 lspec = vec4(1.0, 1.0, 0.9, 0.0);   // 鏡面反射光強度 / specular intensity

// 材質 / material
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);    // 環境光の反射係数 / ambient reflectance
const vec4 kdiff = vec4(0.5, 0.15, 0.1, 1.0);  // 拡散反射係数 / diffuse reflectance
const vec4 kspec = vec4(0.4, 0.35, 0.3, 1.0);  // 鏡面反射係数 / specular reflectance
const float kshi = 24.0;                       // 輝き係数 / shininess

// 頂点シェーダから受け取るものを, ここで宣言してください.
// Declare here what comes from the vertex shader.
in vec3 pos;
in vec3 nrm;

// フレームバッファに出力する色 / colour for the frame buffer
layout (location = 0) out vec4 fc;

void main(void)
{
  vec3 n = normalize(nrm);
  vec3 v = normalize(-pos);
  vec3 l = normalize(pl.xyz - pos);
  vec3 h = normalize(l + v);
  vec4 iamb = kamb * lamb;
  vec4 idiff = max(dot(n, l), 0.0) * kdiff * ldiff;
  vec4 ispec = pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;
  fc = iamb + idiff + ispec;
}
