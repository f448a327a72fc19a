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

vec3 N, L, V, H;
vec4 color = vec4(0.0, 0.0, 0.0, 1.0);

void setup()
{
    vec4 p = mw * pv;
    V = -normalize(p.xyz / p.w);
    L = normalize((pl * p.w - p * pl.w).xyz);
    N = normalize((mg * cv).xyz);
    H = normalize(L + V);
}

void addAmbient()  { color += kamb * lamb; }
void addDiffuse()  { color += max(dot(N, L), 0.0) * kdiff * ldiff; }
void addSpecular() { color += pow(max(dot(N, H), 0.0), kshi) * kspec * lspec; }

void main()
{
    setup();
    addAmbient();
    addDiffuse();
    addSpecular();
    vc = color;
    gl_Position = mc * pv;
}
