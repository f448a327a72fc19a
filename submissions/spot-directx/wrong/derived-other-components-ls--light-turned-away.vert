#version 430 core
const vec4 pl = vec4(1.6, 1.4, -3.4, 1.0);
const vec4 lamb = vec4(0.25, 0.25, 0.3, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 0.95, 0.7, 0.0);
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.75, 0.12, 0.08, 1.0);
const vec4 kspec = vec4(0.4, 0.42, 0.45, 1.0);
const float kshi = 40.0;
const vec4 ldir = vec4(-0.9, -0.6, -1.0, 0.0);
const float sexp = 6.0;
const float thetap = 12.0;
const float thetau = 26.0;
layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

// ローカル座標系で計算する: mw は回転と平行移動だけなので, 長さも角度も変わらない
void main()
{
    mat4 back = inverse(mw);
    vec3 l = normalize((back * pl).yzx - pv.xyz);
    vec3 v = normalize(back[3].xyz - pv.xyz);
    vec3 axis = normalize((back * ldir).xyz);
    vec3 n = normalize(cv.xyz);
    vec3 h = normalize(l + v);
    float ls = -dot(l, axis);
    float c = ls <= cos(radians(thetau)) ? 0.0 : ls < cos(radians(thetap)) ? pow(ls, sexp) : 1.0;
    vc = kamb * lamb;
    vc += kdiff * ldiff * clamp(dot(n, l), 0.0, 1.0);
    vc += kspec * lspec * pow(max(0.0, dot(n, h)), kshi);
    vc *= c;
    gl_Position = mc * pv;
}
