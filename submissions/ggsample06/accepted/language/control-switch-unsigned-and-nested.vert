#version 410 core
// switch on a uint, a switch in a switch, return and continue out of a switch.
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
float pick(uint outer, int inner) {
	switch (outer) {
	case 0u: return 0.0;
	case 1u:
		switch (inner) { case 0: return 2.0; default: break; }
		return 3.0;
	}
	return 4.0;
}
void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
	float sum = 0.0;
	for (int i = 0; i < 5; ++i) {
		switch (i & 1) { case 1: continue; }      // only even i go on
		sum += float(i);                          // 0 + 2 + 4
	}
	float d = max(dot(n, l), 0.0) * (sum + pick(0u, 0) + pick(1u, 0) + pick(1u, 5) + pick(2u, 0)) / 15.0;
	vc = kamb * lamb + d * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
	gl_Position = mc * pv;
}
