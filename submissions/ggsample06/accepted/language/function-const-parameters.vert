#version 410 core
// const and const in parameters; parameters changed inside the function do not touch the caller.
// 光源と材質
const vec4 pl    = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb  = vec4(vec3(0.2), 1.0);
const vec4 ldiff = vec4(vec3(1.0), 0.0);
const vec4 lspec = vec4(vec3(1.0), 0.0);
const vec4 kamb  = vec4(0.6, vec2(0.0), 1.0);
const vec4 kdiff = vec4(0.6, vec2(0.0), 1.0);
const vec4 kspec = vec4(vec3(0.4), 1.0);
const float kshi = 80.0;
// 頂点属性
layout (location = 0) in vec4 pv;
in vec4 cv;

// 変換行列
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

// 頂点色
out vec4 vc;
float lambert(const vec3 n, const in vec3 l) { return max(dot(n, l), 0); }
float blinn(in vec3 n, vec3 h, float e) { n *= 1.0; h += 0.0; e = pow(max(dot(n, h), 0), e); return e; }
void main(void)
{
	vec4 p = mw * pv; // 視点座標系
	vec3 v = -normalize(p.xyz / p.w); // 視線ベクトル
	vec3 l = normalize((pl * p.w - p * pl.w).xyz); // 光線ベクトル
	vec3 n = normalize((mg * cv).xyz); // 法線ベクトル
	vec3 h = normalize(l + v);
	float e = kshi;
	float s = blinn(n, h, e);
	vc = kamb * lamb + lambert(n, l) * kdiff * ldiff + s * kspec * lspec * (e / 80.0);
	gl_Position = mc * pv;
}
