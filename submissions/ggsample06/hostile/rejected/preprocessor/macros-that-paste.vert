#version 410 core
// The bomb is put together from halves.
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;
layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

#define PASTE(a, b) a ## b
#define B_a0 n.x
#define B_a1 PASTE(B_, a0) + PASTE(B_, a0)
#define B_a2 PASTE(B_, a1) + PASTE(B_, a1)
#define B_a3 PASTE(B_, a2) + PASTE(B_, a2)
#define B_a4 PASTE(B_, a3) + PASTE(B_, a3)
#define B_a5 PASTE(B_, a4) + PASTE(B_, a4)
#define B_a6 PASTE(B_, a5) + PASTE(B_, a5)
#define B_a7 PASTE(B_, a6) + PASTE(B_, a6)
#define B_a8 PASTE(B_, a7) + PASTE(B_, a7)
#define B_a9 PASTE(B_, a8) + PASTE(B_, a8)
#define B_a10 PASTE(B_, a9) + PASTE(B_, a9)
#define B_a11 PASTE(B_, a10) + PASTE(B_, a10)
#define B_a12 PASTE(B_, a11) + PASTE(B_, a11)
#define B_a13 PASTE(B_, a12) + PASTE(B_, a12)
#define B_a14 PASTE(B_, a13) + PASTE(B_, a13)
#define B_a15 PASTE(B_, a14) + PASTE(B_, a14)
#define B_a16 PASTE(B_, a15) + PASTE(B_, a15)
#define B_a17 PASTE(B_, a16) + PASTE(B_, a16)
#define B_a18 PASTE(B_, a17) + PASTE(B_, a17)
#define B_a19 PASTE(B_, a18) + PASTE(B_, a18)
#define B_a20 PASTE(B_, a19) + PASTE(B_, a19)
#define B_a21 PASTE(B_, a20) + PASTE(B_, a20)
#define B_a22 PASTE(B_, a21) + PASTE(B_, a21)
#define B_a23 PASTE(B_, a22) + PASTE(B_, a22)
#define B_a24 PASTE(B_, a23) + PASTE(B_, a23)
#define B_a25 PASTE(B_, a24) + PASTE(B_, a24)
#define B_a26 PASTE(B_, a25) + PASTE(B_, a25)
#define B_a27 PASTE(B_, a26) + PASTE(B_, a26)
#define B_a28 PASTE(B_, a27) + PASTE(B_, a27)
#define B_a29 PASTE(B_, a28) + PASTE(B_, a28)
#define B_a30 PASTE(B_, a29) + PASTE(B_, a29)

void main(void)
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec + 0.0 * (B_a30);
  gl_Position = mc * pv;
}
