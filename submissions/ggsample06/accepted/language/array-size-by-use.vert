#version 410 core
// An array without a size that gets its size from a later declaration, and one from its largest index.
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
vec4 terms[];
float factors[];
vec4 terms[3];
void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
	factors[0] = 1.0;
	factors[1] = max(dot(n, l), 0.0);
	factors[2] = pow(max(dot(n, normalize(l + v)), 0.0), kshi);
	terms[0] = kamb * lamb; terms[1] = kdiff * ldiff; terms[2] = kspec * lspec;
	vc = vec4(0.0);
	for (int i = 0; i < terms.length(); i++) terms[i].a = 1.0;
	vc += terms[0] * factors[0] + terms[1] * factors[1] + terms[2] * factors[2];
	gl_Position = mc * pv;
}
