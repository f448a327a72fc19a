#version 410 core
// length, distance, dot, cross, normalize.
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
	vec3 v = -p.xyz / distance(p.xyz, vec3(0)), l = pl.xyz / length(pl.xyz), g = mat3(mg) * cv.xyz, n = g / length(g);
	vec3 side = cross(n, l);
	float d = sqrt(max(1.0 - dot(side, side), 0)) * (dot(n, l) > 0 ? 1.0 : 0.0);   // cos from sin
	vec3 h = (l + v) / length(l + v);
	float zero = dot(cross(n, h), n) + length(cross(vec3(1, 0, 0), vec3(0, 1, 0)) - vec3(0, 0, 1)) + length(-2.0) - distance(1.0, 3.0);
	vc = kamb * lamb + (d + zero) * kdiff * ldiff + pow(max(dot(n, h), 0), kshi) * kspec * lspec;
	gl_Position = mc * pv;
}
