#version 410 core
// The upper left part of a larger matrix: mat3(mat4), mat2(mat4).
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
uniform mat4 mg;
uniform mat4 mc;
uniform mat4 mw;
out vec4 vc;
in vec4 cv;
in vec4 pv;
void main() {
	mat3 normal_matrix = mat3(mg);
	mat2 corner = mat2(mg);
	vec3 n = normal_matrix * cv.xyz;
	n.xy = corner * cv.xy + normal_matrix[2].xy * cv.z;
	n = normalize(n);
	vec4 p = mw * pv;
	vec3 v = normalize(-p.xyz), l = normalize((pl * p.w - p * pl.w).xyz);
	vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff
	   + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
	gl_Position = mc * pv;
}
