#version 410 core
// Parameters named like uniforms, attributes and constants.
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
vec4 product(vec4 pv, mat4 mw) { return mw * pv; }
float shade(float kshi, float kamb) { float lamb = 2.0; return pow(kamb, kshi) * lamb; }
void main() {
	vec4 p = product(pv, mw);
	vec3 v = -normalize(p.xyz), l = pl.xyz, n = normalize(product(cv, mg).xyz);
	float d = 0.5 * shade(1.0, max(dot(n, l), 0.0)), s = shade(kshi, max(dot(n, normalize(l + v)), 0.0)) / 2.0;
	vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
	gl_Position = product(pv, mc);
}
