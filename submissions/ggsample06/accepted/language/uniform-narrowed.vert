#version 410 core
// Uniforms passed to functions, copied to locals and globals, and read column by column.
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
mat4 copy;
vec4 column(mat4 m, int i) { return m[i]; }
void main(void)
{
	copy = mw;
	copy[3].xyz += vec3(0.0);
	vec4 p = copy * pv;
	mat4 local = mg;
	local[0] = column(mg, 0);
	vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((local * cv).xyz);
	vc = kamb * lamb + max(dot(n, l), 0) * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0), kshi) * kspec * lspec;
	gl_Position = column(mc, 0) * pv.x + column(mc, 1) * pv.y + column(mc, 2) * pv.z + column(mc, 3) * pv.w;
}
