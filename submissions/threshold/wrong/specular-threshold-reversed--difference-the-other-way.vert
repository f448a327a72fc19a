#version 330 core
// homework: threshold

const vec4	pl	= vec4(2.4, -0.6, -0.6, 0.0);	// light position
const vec4	lamb	= vec4(0.25, 0.25, 0.3, 1.0);	// ambient light
const vec4	ldiff	= vec4(0.9, 0.85, 0.8, 0.0);	// diffuse light
const vec4	lspec	= vec4(1.0, 0.95, 0.7, 0.0);	// specular light
const vec4	kamb	= vec4(0.5, 0.1, 0.1, 1.0);	// ambient reflectance
const vec4	kdiff	= vec4(0.75, 0.12, 0.08, 1.0);	// diffuse reflectance
const vec4	kspec	= vec4(0.4, 0.42, 0.45, 1.0);	// specular reflectance
const float	t	= 0.903;	// threshold

in vec4	pv;		// position
in vec4	cv;		// normal

uniform mat4	mw, mc, mg;

out vec4	vc;

void main(void)
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);

  vec3 h = normalize(l + v);
  float s = max(t - max(dot(n, h), 0.0), 0.0);
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + s * kspec * lspec;
  gl_Position = mc * pv;
}
