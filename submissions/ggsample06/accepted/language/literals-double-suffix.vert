#version 410
// Double literals with lf and LF, and double constants narrowed by a constructor.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
uniform mat4 mg;
uniform mat4 mc;
uniform mat4 mw;
out vec4 vc;
in vec4 cv;
in vec4 pv;
const double half_turn = 0.5lf;
const dvec3 weights = dvec3(0.25LF, 0.25lf, 5.0e-1lf);
void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
	double d = double(max(dot(n, l), 0.0));
	double sum = d * weights.x + d * weights.y + d * weights.z;   // d once more
	float s = pow(max(dot(n, normalize(l + v)), 0.0), float(half_turn * 160.0lf));
	vc = kamb * lamb + float(sum) * kdiff * ldiff + s * kspec * lspec;
	gl_Position = mc * pv;
}
