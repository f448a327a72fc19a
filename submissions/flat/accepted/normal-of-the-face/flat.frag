#version 410
const vec4 pl = vec4(2.0, 1.5, 1.0, 0.0);
const vec4 lamb = vec4(0.3, 0.3, 0.35, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 0.9, 0.0);
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.7, 0.15, 0.1, 1.0);
const vec4 kspec = vec4(0.4, 0.35, 0.3, 1.0);
const float kshi = 24.0;

in vec4 eyePoint;
flat in vec3 eyeNormal;
layout(location = 0) out vec4 fc;
void main() {
    vec3 V = normalize(-eyePoint.xyz / eyePoint.w);
    vec3 L = normalize(pl.xyz * eyePoint.w - eyePoint.xyz * pl.w);
    vec3 N = normalize(cross(dFdx(eyePoint.xyz), dFdy(eyePoint.xyz)));
    vec3 H = normalize(L + V);
    fc = kamb * lamb;
    fc += kdiff * ldiff * max(dot(N, L), 0);
    fc += kspec * lspec * pow(max(dot(N, H), 0), kshi);
}
