#version 410 core
const vec4 pl = vec4(1.6, 1.4, -3.4, 1.0);
const vec4 lamb = vec4(0.25, 0.25, 0.3, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 0.95, 0.7, 0.0);
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.75, 0.12, 0.08, 1.0);
const vec4 kspec = vec4(0.4, 0.42, 0.45, 1.0);
const float kshi = 40.0;
const vec4 ldir = vec4(-0.9, -0.6, -1.0, 0.0);
const float sexp = 8.0;
layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

struct Lamp { vec4 position; vec3 axis; float exponent; };

float beam(const Lamp lamp, const vec3 place)
{
    vec3 away = normalize(place - lamp.position.xyz / lamp.position.w);
    return pow(max(dot(away, lamp.axis), 0.0), lamp.exponent);
}

void main()
{
    Lamp lamp = Lamp(pl, normalize(ldir.xyz), sexp);
    vec4 p = mw * pv;
    vec3 place = p.xyz / p.w;
    vec3 l = normalize(lamp.position.xyz / lamp.position.w - place);
    vec3 n = normalize((mg * cv).xyz);
    vec3 h = normalize(l + normalize(-place));
    vc = beam(lamp, place) * (kamb * lamb + kdiff * ldiff * max(dot(l, n), 0.0) + kspec * lspec * pow(max(dot(h, n), 0.0), kshi));
    gl_Position = mc * pv;
}
