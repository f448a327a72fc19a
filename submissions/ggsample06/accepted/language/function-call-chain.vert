#version 410 core
// Calls inside calls, results thrown away, functions without parameters and with (void).
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
int calls = 0;
vec4 eye(void) { calls++; return mw * pv; }
vec3 normal() { return normalize((mg * cv).xyz); }
vec3 view() { vec4 p = eye(); return -normalize(p.xyz / p.w); }
vec3 light() { return normalize((pl * eye().w - eye() * pl.w).xyz); }
vec3 halfway() { return normalize(light() + view()); }
float positive(float x) { return max(x, 0); }
void main(void)
{
	eye();                                       // 1
	float d = positive(positive(dot(normal(), light())));      // 2 more
	float s = pow(positive(dot(normal(), halfway())), kshi);   // 3 more
	vc = (kamb * lamb + d * kdiff * ldiff) * float(calls - 5) + s * kspec * lspec;
	gl_Position = mc * pv;
}
