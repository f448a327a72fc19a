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

struct Muki { vec3 n, l, v, h; };
struct Iro { vec4 amb, diff, spec; };

Muki muki()
{
  Muki m;
  m.v = -normalize((mw * pv).xyz);
  m.l = normalize(pl.xyz);
  m.n = normalize((mg * cv).xyz);
  m.h = normalize(m.l + m.v);
  return m;
}

Iro iro(Muki m)
{
  return Iro(kamb * lamb,
             max(dot(m.n, m.l), 0.0) * kdiff * ldiff,
             pow(max(dot(m.n, m.h), 0.0), kshi) * kspec * lspec);
}

vec4 goukei(Iro i)
{
  return i.amb + i.diff + i.spec;
}

void main(void)
{
  vc = goukei(iro(muki()));
  gl_Position = mc * pv;
}
