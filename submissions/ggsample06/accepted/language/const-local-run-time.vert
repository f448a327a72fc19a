#version 410 core
// const locals, initialised by constant expressions.
uniform mat4 mg;
uniform mat4 mc;
uniform mat4 mw;
out vec4 vc;
in vec4 cv;
in vec4 pv;
void main() {
	const vec3 half_red = vec3(0.3, 0, 0), red = half_red * 2.0;
	const mat3 unit = mat3(1.0);
	const float shininess = 4.0 * 20.0, fifth = 1.0 / 5.0;
	const int n_terms = 3;
	vec3 n = unit * normalize((mg * cv).xyz), l = unit[2], v = -normalize((mw * pv).xyz);
	vec3 terms[n_terms] = vec3[n_terms](fifth * red, max(dot(n, l), 0.0) * red,
		vec3(0.4) * pow(max(dot(n, normalize(l + v)), 0.0), shininess));
	vc = vec4(terms[0] + terms[1] + terms[2], 1);
	gl_Position = mc * pv;
}
