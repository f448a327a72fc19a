#version 410 core
// Redefined built-ins that call other built-ins: clamp with one limit, reflect, mix, length.
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
float clamp(float x) { return max(x, 0); }
vec3 mix(vec3 a, vec3 b) { return normalize(a + b); }
float length(vec3 a) { return dot(a, a); }            // squared
vec3 reflect(vec3 a, vec3 b) { return a * 2.0 / length(b * sqrt(2.0)); }
void main(void)
{
	vec4 p = mw * pv; // 視点座標系
	vec3 v = -normalize(p.xyz / p.w); // 視線ベクトル
	vec3 l = normalize((pl * p.w - p * pl.w).xyz); // 光線ベクトル
	vec3 n = normalize((mg * cv).xyz); // 法線ベクトル
	float d = clamp(dot(reflect(n, l), l));           // reflect(n, l) is n
	float s = pow(clamp(dot(n, mix(l, v))), kshi);
	vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
	gl_Position = mc * pv;
}
