#version 410 core
// abs, sign, floor, ceil, trunc, round, roundEven, fract, mod.
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
	float x = dot(n, l);
	float d = (x + abs(x)) / 2.0 * abs(sign(x));
	// floor -2, ceil -1, trunc -1, round 2, roundEven 2, fract .75, mod(-1, 3) = 2
	vec4 r = vec4(floor(-1.25), ceil(-1.25), trunc(-1.75), round(1.75));
	float unit = r.x * r.y * r.z + r.w + roundEven(2.5) + fract(-1.25) * 4.0 + mod(-1.0, 3.0) - 6.0;   // -2+2+2+3+2-6
	vec3 whole = floor(n * 8.0);
	n = (whole + fract(n * 8.0)) / 8.0;
	vc = unit * kamb * lamb + d * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.), kshi) * kspec * lspec;
	gl_Position = mc * pv;
}
