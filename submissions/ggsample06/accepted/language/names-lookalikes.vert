#version 410 core
// Names that begin like built-in ones or reserved words, and names of one letter: glPosition, glColor, GL_x, _x, H, N, L, V, I.
// 光源と材質
const vec4 pl    = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb  = vec4(vec3(0.2), 1.0);
const vec4 ldiff = vec4(vec3(1.0), 0.0);
const vec4 lspec = vec4(vec3(1.0), 0.0);
const vec4 kamb  = vec4(0.6, vec2(0.0), 1.0);
const vec4 kdiff = vec4(0.6, vec2(0.0), 1.0);
const vec4 kspec = vec4(vec3(0.4), 1.0);
const float kshi = 80.0;
// 頂点属性
layout (location = 0) in vec4 pv;
in vec4 cv;

// 変換行列
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

// 頂点色
out vec4 vc;
vec4 glPosition;
float _d, d_, int1, for_, floats, ifs, Main, MAIN, vec, GL_D;
void main(void)
{
	vec4 p = mw * pv; // 視点座標系
	vec3 v = -normalize(p.xyz / p.w); // 視線ベクトル
	vec3 l = normalize((pl * p.w - p * pl.w).xyz); // 光線ベクトル
	vec3 n = normalize((mg * cv).xyz); // 法線ベクトル
	vec3 N = n, L = l, V = v, H = normalize(L + V);
	float O0 = 1.0, l1 = max(dot(N, L), 0), lI = O0;
	GL_D = l1; _d = GL_D; d_ = _d; int1 = d_; for_ = int1; floats = for_; ifs = floats; Main = ifs; MAIN = Main; vec = MAIN;
	vec4 I = kamb * lamb * lI + vec * kdiff * ldiff + pow(max(dot(N, H), 0), kshi) * kspec * lspec;
	glPosition = mc * pv;
	vc = I;
	gl_Position = glPosition;
}
