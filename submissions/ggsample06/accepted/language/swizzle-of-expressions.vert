#version 410 core
// Swizzles of calls, constructors, sums and of other swizzles.
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main()
{
    vec3 n = normalize((mg * cv).xyz), e = -normalize((mw * pv).xyz), l = vec2(0.0, 1.0).xxy;
    float d = max((n * l).x + (n * l).y + (n * l).z, 0.0);
    float s = pow(max(dot(n, normalize(l + e).xyz), 0.0), vec2(80.0, 3.0).yx.y);
    vc = vec4(0.12, 0.0, 0.0, 1.0).xyzw + vec4(0.6, 0.0, 1.0, 0.0).rgga * d + (vec2(0.4, 0.0) * s).xxxy;
    gl_Position = (mc * pv).xyzw;
}
