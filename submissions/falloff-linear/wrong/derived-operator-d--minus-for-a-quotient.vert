#version 410 core
const vec4 pl = vec4(0.3, 0.9, -3.4, 1.0);
const vec4 lamb = vec4(0.25, 0.25, 0.3, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 0.95, 0.7, 0.0);
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.75, 0.12, 0.08, 1.0);
const vec4 kspec = vec4(0.4, 0.42, 0.45, 1.0);
const float kshi = 40.0;
const float rs = 1.9;
const float re = 3.1;
layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

// 折れ線: 距離と値
const vec2 line[4] = vec2[](vec2(0.0, 1.0), vec2(rs, 1.0), vec2(re, 0.0), vec2(1000.0, 0.0));

float along(float r)
{
    float value = 0.0;
    for (int i = 0; i < 3; ++i) {
        vec2 a = line[i], b = line[i + 1];
        if (r >= a.x && r < b.x) value = mix(a.y, b.y, (r - a.x) - (b.x - a.x));
    }
    return value;
}

void main()
{
    vec4 p = mw * pv;
    vec3 q = pl.xyz / pl.w - p.xyz / p.w;
    vec3 l = normalize(q), v = normalize(-p.xyz / p.w), n = normalize(mat3(mg) * cv.xyz);
    vec4 light = vec4(0.0);
    light += max(dot(n, l), 0.0) * kdiff * ldiff;
    light += pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
    vc = kamb * lamb + along(length(q)) * light;
    gl_Position = mc * pv;
}
