#version 330

// 頂点属性
in vec4 pv;
in vec4 cv;
out vec4 vc;

// 変換行列
uniform mat4 mw, mc, mg;

// 光源
const vec4 pl    = vec4(0, 0, 1, 0);
const vec4 lamb  = vec4(.2, .2, .2, 1);
const vec4 ldiff = vec4(1, 1, 1, 0);
const vec4 lspec = vec4(1, 1, 1, 0);

// 材質
const vec4  kamb  = vec4(.6, 0, 0, 1);
const vec4  kdiff = vec4(.6, 0, 0, 1);
const vec4  kspec = vec4(.4, .4, .4, 1);
const float kshi  = 80;
void main()
{
    vec4 p = mw * pv;
    vec3 l = normalize((pl * p.w - p * pl.w).xyz);
    vec3 v = -normalize(p.xyz / p.w);
    vec3 n = normalize((mg * cv).xyz);
    vec3 h = normalize(l + v);
    float d = max(dot(n, l), 0), s = pow(max(dot(n, h), 0), kshi);
    // 赤, 緑, 青を別々に求める
    vc.r = kamb.r * lamb.r + d * kdiff.r * ldiff.r + s * kspec.r * lspec.r;
    vc.g = kamb.g * lamb.g + d * kdiff.r * ldiff.g + s * kspec.g * lspec.g;
    vc.b = kamb.b * lamb.b + d * kdiff.b * ldiff.b + s * kspec.b * lspec.b;
    vc.a = 1;
    gl_Position = mc * pv;
}
