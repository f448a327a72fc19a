#version 410 core
// Global variables changed by functions; one with a constant initialiser, one without any.
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
vec4 sum = vec4(0.0, 0.0, 0.0, 1.0);
vec3 eye;
int count = 1;
void term(vec4 t) { sum.rgb += t.rgb; count *= 2; }
void setup() { vec4 p = mw * pv; eye = p.xyz / p.w; }
void main(void)
{
	setup();
	vec3 v = -normalize(eye), l = normalize(pl.xyz), n = normalize((mg * cv).xyz);
	term(kamb * lamb);
	term(max(dot(n, l), 0) * kdiff * ldiff);
	term(pow(max(dot(n, normalize(l + v)), 0), kshi) * kspec * lspec);
	vc = sum * float(count) / 8.0;
	gl_Position = mc * pv;
}
