#version 410 core
// A constant struct whose members make other constants.
// 頂点属性
layout (location = 0) in vec4 pv;
in vec4 cv;

// 変換行列
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

// 頂点色
out vec4 vc;
struct Material { vec4 ambient, diffuse, specular; float shininess; };
const Material base = Material(vec4(0.6, 0, 0, 1), vec4(0.6, 0, 0, 1), vec4(0.4, 0.4, 0.4, 1), 40.0);
const float shininess = base.shininess * 2.0;
const vec4 ambient = base.ambient * vec4(0.2, 0.2, 0.2, 1);
const int size = int(base.diffuse.r * 5.0 + 0.5);           // 3
void main(void)
{
	vec4 terms[size];
	vec3 v = -normalize((mw * pv).xyz), l = vec3(0, 0, 1), n = normalize((mg * cv).xyz);
	terms[0] = ambient;
	terms[1] = max(dot(n, l), 0) * base.diffuse;
	terms[2] = pow(max(dot(n, normalize(l + v)), 0), shininess) * base.specular;
	vc = terms[0] + terms[1] + terms[2];
	gl_Position = mc * pv;
}
