#version 410 core
// continue and break of a loop and of the switch in it, one falling through.
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;
in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

void main()
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  float d = max(dot(n, l), 0.0);
  float s = pow(max(dot(n, h), 0.0), kshi);
  int sum = 0;
  for (int i = 0; i < 8; i++)
  {
    switch (i)
    {
    case 0: continue;
    case 1: sum += 1;
    case 2: sum += 10; if (i == 2) break; sum += 100; break;
    case 5: { for (int j = 0; j < 3; j++) { if (j == 1) continue; if (j == 2) break; sum += 1000; } }
    case 6: sum += 5; continue;
    default: break;
    }
    sum += 10000;
  }
  // 1: 1 + 10 + 100, 2: 10, 5: 1000 + 5, 6: 5; 1, 2, 3, 4 and 7 reach the end of the body.
  d *= float(sum) / 51131.0;
  vc = kamb * lamb + d * kdiff * ldiff + s * kspec * lspec;
  gl_Position = mc * pv;
}
