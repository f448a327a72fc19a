#version 410 core
// LF, CR LF and CR in one file.
// 光源と材質const vec4 pl    = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb  = vec4(vec3(0.2), 1.0);
const vec4 ldiff = vec4(vec3(1.0), 0.0);const vec4 lspec = vec4(vec3(1.0), 0.0);
const vec4 kamb  = vec4(0.6, vec2(0.0), 1.0);
const vec4 kdiff = vec4(0.6, vec2(0.0), 1.0);const vec4 kspec = vec4(vec3(0.4), 1.0);
const float kshi = 80.0;
// 頂点属性layout (location = 0) in vec4 pv;
in vec4 cv;
// 変換行列
uniform mat4 mw;
uniform mat4 mc;uniform mat4 mg;

// 頂点色out vec4 vc;
void main(void)
{	vec4 p = mw * pv; // 視点座標系
	vec3 v = -normalize(p.xyz / p.w); // 視線ベクトル
	vec3 l = normalize((pl * p.w - p * pl.w).xyz); // 光線ベクトル	vec3 n = normalize((mg * cv).xyz); // 法線ベクトル
	vc = kamb * lamb + max(dot(n, l), 0) * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0), kshi) * kspec * lspec;
	gl_Position = mc * pv;}
