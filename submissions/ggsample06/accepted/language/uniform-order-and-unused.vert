#version 410 core
// Uniforms in another order, one of the three not used, declared between functions.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
uniform mat4 mg;
in vec4 cv;
float positive(float x) { return max(x, 0.0); }
uniform mat4 mc;
out vec4 vc;
in vec4 pv;
uniform mat4 mw;
uniform mat4 extra;
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz), l = normalize(pl.xyz), n = normalize(transpose(inverse(mat3(mw))) * cv.xyz);
    vc = kamb * lamb + positive(dot(n, l)) * kdiff * ldiff + pow(positive(dot(n, normalize(l + v))), kshi) * kspec * lspec;
    gl_Position = mc * pv;
}
