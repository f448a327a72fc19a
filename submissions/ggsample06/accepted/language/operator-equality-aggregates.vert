#version 410 core
// == and != on vectors, matrices, arrays and structs.
const float kshi=80.0;
const vec4 kspec=vec4(0.4,0.4,0.4,1.0);
const vec4 kdiff=vec4(0.6,0.0,0.0,1.0);
const vec4 kamb=vec4(0.6,0.0,0.0,1.0);
const vec4 lspec=vec4(1.0,1.0,1.0,0.0);
const vec4 ldiff=vec4(1.0,1.0,1.0,0.0);
const vec4 lamb=vec4(0.2,0.2,0.2,1.0);
const vec4 pl=vec4(0.0,0.0,1.0,0.0);
uniform mat4 mg;
uniform mat4 mc;
uniform mat4 mw;
out vec4 vc;
in vec4 cv;
in vec4 pv;
struct Pair { float a; vec2 b; };
void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
	Pair x = Pair(1.0, vec2(2, 3)), y = Pair(1.0, vec2(2, 3)), z = Pair(1.0, vec2(2, 4));
	float a[2] = float[2](0.5, 0.25), q[2] = float[](0.5, 0.25);
	bool same = x == y && x != z && a == q && mat2(1.0) == mat2(1, 0, 0, 1) && vec3(1) != vec3(1, 1, 2);
	q[1] = 0.125;
	bool other = a != q && !(y == z) && !(mat2(1.0) != mat2(1.0));
	float d = same && other ? max(dot(n, l), 0.0) : 1.0;
	vc = kamb * lamb + d * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
	gl_Position = mc * pv;
}
