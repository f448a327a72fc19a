#version 410 core
// pow, exp, log, exp2, log2, sqrt, inversesqrt.
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
	vec4 p = mw * pv;
	vec3 e = p.xyz / p.w, g = (mg * cv).xyz;
	vec3 v = -e * inversesqrt(dot(e, e)), l = normalize((pl * p.w - p * pl.w).xyz), n = g / sqrt(g.x * g.x + g.y * g.y + g.z * g.z);
	float x = max(dot(n, normalize(l + v)), 1e-6);
	float d = max(dot(n, l), 0), root = sqrt(pow(d, 2.0));
	float s = 0.5 * exp2(kshi * log2(x)) + 0.5 * exp(log(x) * kshi);
	vc = kamb * lamb * exp2(0.0) + root * kdiff * ldiff + s * kspec * lspec;
	gl_Position = mc * pv;
}
