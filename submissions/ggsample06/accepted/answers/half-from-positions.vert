#version 410 core
/*
	課題6  Gouraud shading
*/
in	vec4	pv;
in	vec4	cv;
out	vec4	vc;
uniform	mat4	mw;
uniform	mat4	mc;
uniform	mat4	mg;

const	vec4	pl	= vec4(0.0, 0.0, 1.0, 0.0);
const	vec4	lamb	= vec4(0.2, 0.2, 0.2, 1.0);
const	vec4	ldiff	= vec4(1.0, 1.0, 1.0, 0.0);
const	vec4	lspec	= vec4(1.0, 1.0, 1.0, 0.0);
const	vec4	kamb	= vec4(0.6, 0.0, 0.0, 1.0);
const	vec4	kdiff	= vec4(0.6, 0.0, 0.0, 1.0);
const	vec4	kspec	= vec4(0.4, 0.4, 0.4, 1.0);
const	float	kshi	= 80.0;

void main(void)
{
	// everything from the eye-space position
	vec4 pos = mw * pv;
	vec3 toLight = pl.xyz * pos.w - pos.xyz * pl.w;
	vec3 toEye = -pos.xyz;
	vec3 hv = normalize(toLight) + normalize(toEye);
	vec3 n = normalize(mat3(mg) * cv.xyz);

	float d = dot(n, normalize(toLight));
	float s = dot(n, normalize(hv));

	vc = kamb * lamb
	   + (d > 0.0 ? d : 0.0) * (kdiff * ldiff)
	   + (s > 0.0 ? pow(s, kshi) : 0.0) * (kspec * lspec);
	gl_Position = mc * pv;
}
