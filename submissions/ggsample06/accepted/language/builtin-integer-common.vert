#version 410 core
// abs, sign, min, max and clamp of integers and of their vectors.
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
	ivec3 a = abs(ivec3(-3, 2, -1)), s = sign(ivec3(-9, 0, 9));          // 3 2 1, -1 0 1
	uvec2 u = clamp(uvec2(1u, 9u), 3u, 5u);                              // 3 5
	int lo = min(a.x, min(a.y, a.z)), hi = max(a, 2).x;                  // 1, 3
	float unit = float(lo * hi * -s.x * s.z) / float(u.x) * float(clamp(-7, 0, 4) + 1 + s.y) * float(u.y) / 5.0;
	float d = max(dot(n, l), 0.0) * unit;
	vc = unit * kamb * lamb + d * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.), kshi) * kspec * lspec;
	gl_Position = mc * pv;
}
