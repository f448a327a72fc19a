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
    vec3 l = vec3(0.0, 0.0, 1.0);          // 平行光源なので方向は一定
    vec3 v = normalize(-(mw * pv).xyz);    // 視点は原点
    vec3 n = normalize((mg * cv).xyz);
    vec3 h = normalize(l + v);

    vec4 iamb  = lamb * kamb;
    vec4 idiff = ldiff * kdiff * max(n.z, 0.0);   // dot(n, (0,0,1)) = n.z
    vec4 ispec = lspec * kspec * pow(max(dot(n, h), 0.0), kshi);

    vc = iamb + idiff + ispec;
    gl_Position = mc * pv;
}
