#version 410 core
// mat4x3, mat3x4, mat2x3, mat3x2 and their products: mat4x3 has 4 columns of 3 rows.
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
	mat4x3 to_eye = mat4x3(mw);                           // the fourth row is dropped
	vec3 eye = to_eye * pv;
	vec3 v = -normalize(eye), l = normalize(pl.xyz);
	mat3x4 wide = mat3x4(mg);                             // the fourth column is dropped
	vec3 n = normalize((wide * cv.xyz).xyz);
	mat2x3 lh = mat2x3(l, normalize(l + v));
	vec2 ds = max(n * lh, 0.0);                           // dot with each column
	mat3x2 hl = transpose(lh);
	ds = 0.5 * ds + 0.5 * max(hl * n, 0.0);
	mat2x4 colours = mat2x4(kdiff * ldiff, kspec * lspec);
	vc = kamb * lamb + colours * vec2(ds.x, pow(ds.y, kshi));
	gl_Position = mc * pv;
}
