#version 410 core
// += -= *= /= on scalars, vectors and matrices, and an assignment as an expression.
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
	float d, s;
	d = s = 0.0;
	d += max(dot(n, l), s);
	d *= 6.0; d /= 3.0; d -= d / 2.0;
	s += (s = pow(max(dot(n, normalize(l + v)), 0.0), kshi)) * 0.0;
	vec4 c = kamb;
	c *= lamb;
	c += kdiff * (d *= 1.0) * ldiff;
	c -= -s * kspec * lspec;
	mat4 m = mc;
	m *= 2.0; m /= mat4(vec4(2), vec4(2), vec4(2), vec4(2)); m += mat4(1.0); m -= mat4(1.0);
	vc = c;
	gl_Position = m * pv;
}
