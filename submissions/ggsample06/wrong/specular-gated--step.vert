#version 410 core
//
// ggsample06 グーローシェーディング
//

in vec4 pv;                       // ローカル座標系の頂点位置
in vec4 cv;                       // 頂点の法線ベクトル
out vec4 vc;                      // 頂点の色

uniform mat4 mw, mc, mg;

const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);        // 光源位置
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);      // 環境光
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);     // 拡散光
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);     // 鏡面光
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);      // 環境光の反射係数
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);     // 拡散反射係数
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);     // 鏡面反射係数
const float kshi = 80.0;                         // 輝き係数

void main()
{
    // 視点座標系での計算
    vec4 p = mw * pv;                                // 頂点位置
    vec3 v = -normalize(p.xyz / p.w);                // 視線
    vec3 l = normalize((pl * p.w - p * pl.w).xyz);   // 光線
    vec3 n = normalize((mg * cv).xyz);               // 法線
    vec3 h = normalize(l + v);
    vec4 iamb = kamb * lamb;
    vec4 idiff = max(dot(n, l), 0.0) * kdiff * ldiff;
    vec4 ispec = step(0.0, dot(n, l)) * pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;
    vc = iamb + idiff + ispec;
    gl_Position = mc * pv;
}
