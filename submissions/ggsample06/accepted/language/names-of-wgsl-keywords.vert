#version 410 core
// Names that are keywords of other shading languages: fn, let, var, loop, ptr, array, type, override, enable, mut.
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
struct fn { float let, var; };
float loop(float ptr) { return max(ptr, 0.0); }
vec3 override(vec3 mut) { return normalize(mut); }
void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
	fn array;
	array.let = loop(dot(n, l));
	array.var = pow(loop(dot(n, override(l + v))), kshi);
	float type = 1.0, enable = 1.0, alias = 1.0, storage = 1.0, function = 1.0, self = 1.0, loop_ = 1.0;
	for (int continuing = 0; continuing < 2; continuing++) type += float(continuing);      // 2
	float fallthrough = type * enable * alias * storage * function * self * loop_ / 2.0;
	vc = fallthrough * kamb * lamb + array.let * kdiff * ldiff + array.var * kspec * lspec;
	gl_Position = mc * pv;
}
