#version 410 core
// Names that feel reserved and are not at 4.10: color, position, normal, light, vertex, fragment, uniforms, data, result, entry.
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
vec3 normal, light, view;
vec4 result;
void vertex(vec4 position) { view = -normalize(position.xyz / position.w); light = normalize((pl * position.w - position * pl.w).xyz); }
void entry() { result = kamb * lamb; }
void main(void)
{
	vertex(mw * pv);
	normal = normalize((mg * cv).xyz);
	entry();
	float data = max(dot(normal, light), 0), fragment = pow(max(dot(normal, normalize(light + view)), 0), kshi);
	vec4 color = result + data * kdiff * ldiff;
	vc = color + fragment * kspec * lspec;
	gl_Position = mc * pv;
}
