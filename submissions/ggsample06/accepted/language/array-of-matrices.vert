#version 410 core
// An array of matrices, indexed with a variable, then column, then row.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main()
{
    mat4 m[3] = mat4[3](mw, mc, mg);
    vec4 r[3];
    for (int i = 0; i < 3; i++) {
        r[i] = vec4(0.0);
        for (int c = 0; c < 4; c++)
            for (int k = 0; k < 4; k++)
                r[i][k] += m[i][c][k] * (i == 2 ? cv : pv)[c];
    }
    vec3 v = -normalize(r[0].xyz / r[0].w), l = normalize(pl.xyz), n = normalize(r[2].xyz);
    vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec;
    gl_Position = r[1];
}
