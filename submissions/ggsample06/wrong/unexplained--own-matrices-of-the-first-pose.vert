#version 410 core
// mg and mw not used: the driver drops them; the eye-space vectors come from inverse matrices.
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
	vec4 q = mc * pv;
	mat4 projection = mat4(0.0);
	float f = 1.0 / tan(0.25);
	projection[0][0] = f * 0.75; projection[1][1] = f; projection[2][2] = -16.0 / 14.0; projection[2][3] = -1.0; projection[3][2] = -30.0 / 14.0;
	mat4 view = inverse(projection) * mc;
	vec3 v = -normalize((view * pv).xyz), l = normalize(pl.xyz), n = normalize(transpose(inverse(mat3(view))) * cv.xyz);
	vc = kamb * lamb + max(dot(n, l), 0.) * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.), kshi) * kspec * lspec;
	gl_Position = q;
}
