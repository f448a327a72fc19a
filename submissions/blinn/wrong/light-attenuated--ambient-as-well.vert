#version 330 core
const vec4 pl = vec4(0.3, -0.7, -3.4, 1.0);
const vec4 lamb = vec4(0.25, 0.25, 0.3, 1.0);
const vec4 ldiff = vec4(0.9, 0.85, 0.8, 0.0);
const vec4 lspec = vec4(1.0, 0.95, 0.7, 0.0);
const vec4 kamb = vec4(0.5, 0.1, 0.1, 1.0);
const vec4 kdiff = vec4(0.75, 0.12, 0.08, 1.0);
const vec4 kspec = vec4(0.4, 0.42, 0.45, 1.0);
const float kshi = 40.0;
layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;


struct Frame { vec3 pos, n, l, v; };

Frame look()
{
    Frame f;
    vec4 t4 = mw * pv;
    f.pos = t4.xyz / t4.w;
    f.n = normalize(mat3(mg) * cv.xyz);
    f.v = normalize(-f.pos);
    f.l = normalize(pl.xyz - f.pos);
    return f;
}

void main()
{
    gl_Position = mc * pv;
    Frame f = look();
    vec3 c = vec3(0.0);
    float k = dot(f.n, f.l);
    if (k < 0.0) k = 0.0;
    c += k * kdiff.rgb * ldiff.rgb;
    vec3 hw = f.l + f.v;
    float s = dot(hw, f.n) / length(hw);
    s = s > 0.0 ? pow(s, kshi) : 0.0;
    c += s * kspec.rgb * lspec.rgb;
    c += kamb.rgb * lamb.rgb;

    c /= length(pl.xyz - f.pos);
    vc = vec4(c, 1.0);
}
