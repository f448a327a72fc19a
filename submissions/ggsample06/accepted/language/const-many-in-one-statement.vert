#version 410 core
// Many declarations in one statement, later ones using earlier ones.
const float a = 0.2, b = 3.0 * a, c = 2.0 * a, e = 80.0;
const vec4 pl = vec4(0, 0, 1, 0), kd = vec4(b, 0, 0, 1), ks = vec4(c, c, c, 1), ka = kd * vec4(a, a, a, 1);
in vec4 pv, cv; uniform mat4 mw, mc, mg; out vec4 vc;
void main()
{
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w), l = normalize((pl * p.w - p * pl.w).xyz), n = normalize((mg * cv).xyz);
    float d = max(dot(n, l), 0.), x = dot(n, normalize(l + v)), y = max(x, 0.), s = pow(y, e);
    vc = ka + d * kd + s * ks, gl_Position = mc * pv;
}
