#version 410 core
// in, out and inout: copied in at the call, copied out at the return.
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
void vectors(in vec4 position, out vec3 view, out vec3 light) {
	view = -normalize(position.xyz / position.w);
	light = normalize((pl * position.w - position * pl.w).xyz);
}
void add(inout vec4 sum, vec4 term) { sum += term; term = vec4(77.0); }
void main() {
	vec4 p = mw * pv;
	vec3 v, l, n = normalize((mg * cv).xyz);
	vectors(p, v, l);
	vec4 colour = kamb * lamb, spec = pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
	add(colour, max(dot(n, l), 0.0) * kdiff * ldiff);
	add(colour, spec);
	add(colour, spec - spec);
	vc = colour;
	gl_Position = mc * pv;
}
