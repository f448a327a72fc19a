#version 410 core
// Writing columns, swizzled columns and elements of a matrix, at constant and variable indices.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
uniform mat4 mg;
uniform mat4 mc;
uniform mat4 mw;
out vec4 vc;
in vec4 cv;
in vec4 pv;
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
	mat4 m = mat4(0.0);
	for (int i = 0; i < 3; i++) m[i].xyz = mc[i].xyz;
	int last = 3;
	m[last] = mc[last];
	m[0].w = mc[0].w; m[1][last] = mc[1][3]; m[2].wz = mc[2].wz;
	m[1].x += 1.0; m[1].x--;
	vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff
	   + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
	gl_Position = m * pv;
}
