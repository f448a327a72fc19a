#version 410 core
// ggsample06.vert
// kadai 6: gouraud shading

// hikari
const vec4 pl    = vec4(0.0, 0.0, 1.0, 0.0);  // kougen no ichi
const vec4 lamb  = vec4(0.2, 0.2, 0.2, 1.0);  // kankyoukou
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);  // kakusan
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);  // kyoumen

// zaishitsu
const vec4 kamb  = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;                      // kagayaki keisuu

// nyuuryoku
layout (location = 0) in vec4 pv;
in vec4 cv;

uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

// shutsuryoku
out vec4 vc;

void main(void)
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);

  float nl = dot(n, l);
  if (nl > 0.0) {
    nl = 0.0;   // mainasu wo nakusu
  }

  float nh = dot(n, h);
  if (nh < 0.0) {
    nh = 0.0;
  }

  vc = kamb * lamb + nl * kdiff * ldiff + pow(nh, kshi) * kspec * lspec;
  gl_Position = mc * pv;
}
