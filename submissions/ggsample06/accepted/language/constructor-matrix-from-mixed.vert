#version 410 core
// A matrix from vectors and scalars that do not end at columns.
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
void main()
{
	// Columns (1,2,3), (4,5,6), (7,8,9) / 9, out of unlike pieces.
	mat3 m = mat3(vec2(1, 2), vec4(3, 4, 5, 6), 7, vec2(8, 9)) / 9.0;
	mat3 same = mat3(1.0 / 9.0, 2.0 / 9.0, 3.0 / 9.0, 4.0 / 9.0, 5.0 / 9.0, 6.0 / 9.0, 7.0 / 9.0, 8.0 / 9.0, 1.0);
	vec4 p = mw * pv; // 視点座標系
	vec3 v = -normalize(p.xyz / p.w); // 視線ベクトル
	vec3 l = normalize((pl * p.w - p * pl.w).xyz); // 光線ベクトル
	vec3 n = normalize((mg * cv).xyz); // 法線ベクトル
	vec3 difference = (m - same) * vec3(100.0, 10.0, 1.0);
	vec3 h = normalize(l + v);
	vc = kamb * lamb + max(dot(n, l), 0) * kdiff * ldiff + pow(max(dot(n, h), 0), kshi) * kspec * lspec;
	vc.rgb += difference;
	gl_Position = mc * pv;
}
