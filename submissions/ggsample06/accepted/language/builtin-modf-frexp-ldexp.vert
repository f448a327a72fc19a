#version 410 core
// modf, frexp and ldexp with their out parameters, scalar and vector.
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
void main(void)
{
	vec4 p = mw * pv; // 視点座標系
	vec3 v = -normalize(p.xyz / p.w); // 視線ベクトル
	vec3 l = normalize((pl * p.w - p * pl.w).xyz); // 光線ベクトル
	vec3 n = normalize((mg * cv).xyz); // 法線ベクトル
	float d = max(dot(n, l), 0), whole;
	float part = modf(d * 4.0, whole);
	d = (whole + part) / 4.0;
	int e;
	float m = frexp(d + 1.0, e);
	d = ldexp(m, e) - 1.0;
	ivec2 es;
	vec2 ms = frexp(vec2(12.0, 0.75), es);                  // .75 * 2^4, .75 * 2^0
	float unit = ms.x * float(es.x) / 3.0 + float(es.y) + ldexp(ms.y, 2) - 3.0;
	vec3 parts, wholes;
	parts = modf(vec3(1.5, -1.5, 2.0), wholes);
	unit *= wholes.x * -wholes.y * wholes.z / 2.0 * (parts.x - parts.y + parts.z);
	vc = unit * kamb * lamb + d * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0), kshi) * kspec * lspec;
	gl_Position = mc * pv;
}
