#version 410 core
#define LIGHT_POS vec4(0.0, 0.0, 1.0, 0.0)
#define L_AMB     vec4(0.2, 0.2, 0.2, 1.0)
#define L_DIFF    vec4(1.0, 1.0, 1.0, 0.0)
#define L_SPEC    vec4(1.0, 1.0, 1.0, 0.0)
#define K_AMB     vec4(0.6, 0.0, 0.0, 1.0)
#define K_DIFF    vec4(0.6, 0.0, 0.0, 1.0)
#define K_SPEC    vec4(0.4, 0.4, 0.4, 1.0)
#define K_SHI     80.0
#define POSITIVE_DOT(a, b) max(dot((a), (b)), 0.0)

in vec4 pv;
in vec4 cv;
out vec4 vc;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

void main(void)
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((LIGHT_POS * p.w - p * LIGHT_POS.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);

  vc = K_AMB * L_AMB
     + POSITIVE_DOT(n, l) * K_DIFF * L_DIFF
     + pow(POSITIVE_DOT(n, h), K_SHI) * K_SPEC * L_SPEC;

  gl_Position = mc * pv;
}
