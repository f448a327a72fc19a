#version 410 core
// mat4x4, mat3x3 and mat2x2 are other names of mat4, mat3 and mat2.
// 光源と材質
const vec4 pl    = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb  = vec4(vec3(0.2), 1.0);
const vec4 ldiff = vec4(vec3(1.0), 0.0);
const vec4 lspec = vec4(vec3(1.0), 0.0);
const vec4 kamb  = vec4(0.6, vec2(0.0), 1.0);
const vec4 kdiff = vec4(0.6, vec2(0.0), 1.0);
const vec4 kspec = vec4(vec3(0.4), 1.0);
const float kshi = 80.0;
layout(location = 0) in vec4 pv;
in vec4 cv;
uniform mat4x4 mw;
uniform mat4x4 mc;
uniform mat4x4 mg;
out vec4 vc;
void main()
{
	mat3x3 normals = mat3(mg);
	mat2x2 unit = mat2(1.0);
	vec4 p = mw * pv; // 視点座標系
	vec3 v = -normalize(p.xyz / p.w); // 視線ベクトル
	vec3 l = normalize((pl * p.w - p * pl.w).xyz); // 光線ベクトル
	vec3 n = normalize((mg * cv).xyz); // 法線ベクトル
	n = normalize(normals * cv.xyz);
	n.xy = unit * n.xy;
	vec4 iamb = kamb * lamb;
	vec4 idiff = max(dot(n, l), 0) * kdiff * ldiff;
	vec4 ispec = pow(max(dot(n, normalize(l + v)), 0), kshi) * kspec * lspec;
	vc = iamb + idiff + ispec;
	gl_Position = mc * pv;
}
