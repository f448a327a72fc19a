#version 410 core
// Three thousand rounds, far from any driver's limit.
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
	float d = 0.0, share = max(dot(n, l), 0.0) / 4096.0;
	for (int i = 0; i < 4096; i++) d += share;
	vc = kamb * lamb + d * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
	gl_Position = mc * pv;
}
