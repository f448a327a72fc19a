#version 410 core
// int(float) cuts towards zero, uint(int) keeps the bits, bool(x) is x != 0, float(bool) is 0 or 1.
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
void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
	float facing = dot(n, l);
	int down = int(-1.75), up = int(1.75);                  // -1, 1
	uint bits = uint(-1);
	float one = float(bits >> 31u), zero = float(down + up);
	float gate = float(bool(max(facing, zero)));
	float d = facing * gate;
	float s = pow(max(dot(n, normalize(l + v)), zero), kshi);
	vc = one * kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
	gl_Position = mc * pv;
}
