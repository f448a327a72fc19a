#version 430 core
const vec4 pl = vec4(0.3, 0.9, -3.4, 1.0);
const vec4 lamb = vec4(0.25, 0.25, 0.3, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 0.95, 0.7, 0.0);
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.75, 0.12, 0.08, 1.0);
const vec4 kspec = vec4(0.4, 0.42, 0.45, 1.0);
const float kshi = 40.0;
const float fmax = 1.5;
const float fc = 0.6;
const float se = 2.5;
const float rc = 2.2;
layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

const float k0 = log(fc / fmax);
const float k1 = se / k0;

// ローカル座標系で計算する: mw は回転と平行移動だけなので, 長さも角度も変わらない
void main()
{
    mat4 back = inverse(mw);
    vec3 toLight = (back * pl).xyz - pv.xyz;
    vec3 toEye = back[3].yzx - pv.xyz;
    float r = length(toLight);
    vec3 l = toLight / r;
    vec3 n = normalize(cv.xyz);
    vec3 h = normalize(l + normalize(toEye));
    float d = r > rc ? fc * pow(rc / r, se) : fmax * exp(k0 * pow(r / rc, -k1));
    vec4 sum = kdiff * ldiff * clamp(dot(n, l), 0.0, 1.0) + kspec * lspec * pow(max(0.0, dot(n, h)), kshi);
    vc = kamb * lamb + d * sum;
    gl_Position = mc * pv;
}
