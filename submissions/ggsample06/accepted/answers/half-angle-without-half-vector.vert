#version 410 core

/* ---------- 入力 ---------- */
layout(location=0) in vec4 pv;	// 頂点の位置
in vec4 cv;			// 頂点の法線

/* ---------- 出力 ---------- */
out vec4 vc;			// 頂点の色

/* ---------- 行列 ---------- */
uniform mat4 mw, mc, mg;

/* ---------- 光源 ---------- */
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);

/* ---------- 材質 ---------- */
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;

void main(void)
{
	vec4 p = mw * pv;
	vec3 v = -normalize(p.xyz / p.w);
	vec3 l = normalize((pl * p.w - p * pl.w).xyz);
	vec3 n = normalize((mg * cv).xyz);
	// |l + v|^2 = 2 + 2 (l・v) なので, h を作らなくても n・h が求められる
	float nh = (dot(n, l) + dot(n, v)) / sqrt(2.0 + 2.0 * dot(l, v));
	vec4 iamb = kamb * lamb;
	vec4 idiff = max(dot(n, l), 0.0) * kdiff * ldiff;
	vec4 ispec = pow(max(nh, 0.0), kshi) * kspec * lspec;
	vc = iamb + idiff + ispec;
	gl_Position = mc * pv;
}
