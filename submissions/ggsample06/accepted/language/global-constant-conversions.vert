#version 410 core
// Constants of integer types that other constants are built from.
const int percent = 60, shift = 4;
const uint five = 5u;
const float kr = percent / 100.0, kshi = five << shift;            // 0.6, 80
const vec3 amb = vec3(percent, 0, 0) / (100 * int(five));
const bool use_half = percent > 50 && five != 4u;
const float gain = use_half ? 1.0 : 0.5;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main()
{
    vec3 n = normalize((mg * cv).xyz), l = vec3(0, 0, 1), v = -normalize((mw * pv).xyz);
    vc = vec4(amb + gain * max(dot(n, l), 0) * vec3(kr, 0, 0) + pow(max(dot(n, normalize(l + v)), 0), kshi) * 0.4, 1);
    gl_Position = mc * pv;
}
