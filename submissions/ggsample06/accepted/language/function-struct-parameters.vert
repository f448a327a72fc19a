#version 410 core
// Structs as parameters, inout parameters and results.
const vec4 pl = vec4(0, 0, 1, 0), lamb = vec4(.2, .2, .2, 1), ldiff = vec4(1, 1, 1, 0), lspec = ldiff;
const vec4 kamb = vec4(.6, 0, 0, 1), kdiff = kamb, kspec = vec4(.4, .4, .4, 1);
const float kshi = 80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
struct Surface { vec3 p, n; };
struct Result { vec4 colour; int terms; };
Surface surface() { vec4 p = mw * pv; return Surface(p.xyz / p.w, normalize((mg * cv).xyz)); }
vec3 to_eye(Surface s) { s.p = -s.p; return normalize(s.p); }
void add(inout Result r, vec4 term) { r.colour += term; r.terms++; }
void main()
{
    Surface s = surface();
    vec3 l = normalize(pl.xyz), h = normalize(l + to_eye(s));
    Result r = Result(vec4(0), 0);
    add(r, kamb * lamb);
    add(r, max(dot(s.n, l), 0.0) * kdiff * ldiff);
    add(r, pow(max(dot(s.n, h), 0.0), kshi) * kspec * lspec);
    vc = r.colour * float(r.terms - 2);
    gl_Position = mc * pv;
}
