#version 410 core
// % on int, uint and integer vectors.
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
	int seven = 7;
	uint big = 4294967295u;
	ivec3 r = ivec3(17, 23, 9) % seven;              // 3, 2, 2
	r %= ivec3(2, 2, 3);                             // 1, 0, 2
	uint u = big % 10u;                              // 5
	float unit = float(r.x) * float(u) * float(r.z) / 10.0 + float(r.y);
	float d = 0.0;
	for (int i = 0; i < 9; i++) if (i % 3 == 2) d += n[i / 3] * l[i / 3];
	d = max(d, 0.0);
	vc = unit * kamb * lamb + d * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
	gl_Position = mc * pv;
}
