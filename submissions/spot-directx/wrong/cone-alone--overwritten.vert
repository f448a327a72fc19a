#version 410 core

//
// spot-directx.vert: DirectX のスポットライト / the spotlight of DirectX
//

// 光源 (視点座標系, w = 1 なので点光源) / light (eye space; w = 1: a point light)
const vec4 pl = vec4(1.6, 1.4, -3.4, 1.0);
const vec4 lamb = vec4(0.25, 0.25, 0.3, 1.0);  // 環境光強度 / ambient intensity
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);  // 拡散反射光強度 / diffuse intensity
const vec4 lspec = vec4(1.0, 0.95, 0.7, 0.0);  // 鏡面反射光強度 / specular intensity

// 材質 / material
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);      // 環境光の反射係数 / ambient reflectance
const vec4 kdiff = vec4(0.75, 0.12, 0.08, 1.0);  // 拡散反射係数 / diffuse reflectance
const vec4 kspec = vec4(0.4, 0.42, 0.45, 1.0);   // 鏡面反射係数 / specular reflectance
const float kshi = 40.0;                         // 輝き係数 / shininess

// スポットライト (視点座標系) / spotlight (eye space)
const vec4 ldir = vec4(-0.9, -0.6, -1.0, 0.0);  // 光軸の方向, 光源から外向き / direction of the axis, away from the light
const float sexp = 6.0;                         // 光の集中の度合い (指数) / exponent of the cone
const float thetap = 12.0;                      // 内側の円錐の半頂角 (度) / half angle of the inner cone, in degrees
const float thetau = 26.0;                      // 外側の円錐の半頂角 (度) / half angle of the outer cone, in degrees

// 頂点属性 / vertex attributes
layout (location = 0) in vec4 pv;             // ローカル座標系の頂点位置 / position in object space
in vec4 cv;                                   // ローカル座標系の頂点の法線ベクトル / normal in object space

// 変換行列 / matrices
uniform mat4 mw;                              // モデルビュー変換行列 / model-view matrix
uniform mat4 mc;                              // モデルビュー・投影変換行列 / model-view-projection matrix
uniform mat4 mg;                              // 法線ベクトルの変換行列 / normal matrix

// ラスタライザに送る頂点の色 / vertex colour for the rasteriser
out vec4 vc;

// 補助の関数
float lam(vec3 a, vec3 b)
{
  float c = dot(a, b);
  return max(c, 0.0);
}
float shine(vec3 nn, vec3 a, vec3 b)
{
  vec3 half_ = normalize(a + b);
  return pow(lam(nn, half_), kshi);
}
float beam(vec3 a)
{
  float ct = dot(-a, normalize(ldir.xyz));
  if (ct >= cos(radians(thetap))) return 1.0;
  if (ct <= cos(radians(thetau))) return 0.0;
  return pow(ct, sexp);
}

void main(void)
{
  // 視点座標系に移す
  vec4 q = mw * pv;
  vec3 e = q.xyz / q.w;
  vec3 toEye = normalize(-e);
  vec3 toLight = normalize((pl * q.w - q * pl.w).xyz);
  vec3 nrm = normalize((mg * cv).xyz);

  vec4 amb = kamb * lamb;
  vec4 dif = lam(nrm, toLight) * kdiff * ldiff;
  vec4 spe = shine(nrm, toLight, toEye) * kspec * lspec;
  vc = amb + dif + spe;
  vc = vec4(beam(toLight));

  gl_Position = mc * pv;
}
