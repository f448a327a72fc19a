#version 410 core
// The right side of && and || is left out when the left side decides: calls with side effects.
const float kshi=80.0;
const vec4 kspec=vec4(0.4,0.4,0.4,1.0);
const vec4 kdiff=vec4(0.6,0.0,0.0,1.0);
const vec4 kamb=vec4(0.6,0.0,0.0,1.0);
const vec4 lspec=vec4(1.0,1.0,1.0,0.0);
const vec4 ldiff=vec4(1.0,1.0,1.0,0.0);
const vec4 lamb=vec4(0.2,0.2,0.2,1.0);
const vec4 pl=vec4(0.0,0.0,1.0,0.0);
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
float calls = 0.0;
bool count(bool result) { calls += 1.0; return result; }
void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    bool a = false && count(true);        // no call
    bool b = true || count(false);        // no call
    bool c = count(true) && count(false); // two
    bool d = count(false) || count(true); // two
    bool e = count(true) ^^ count(true);  // two: ^^ takes both
    float diffuse = max(dot(n, l), 0.0) * (calls - 5.0);
    if (a || !b || c || !d || e) diffuse = 1.0;
    vc = kamb * lamb + diffuse * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
