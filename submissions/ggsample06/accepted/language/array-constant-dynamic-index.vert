#version 410 core
// Constant arrays read with a variable index.
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
const vec4 material[3] = vec4[3](vec4(.6, 0, 0, 1), vec4(.6, 0, 0, 1), vec4(.4, .4, .4, 1));
const float light[3] = float[](0.2, 1.0, 1.0);
const int order[3] = int[3](2, 0, 1);
void main()
{
    vec3 v = -normalize((mw * pv).xyz), l = vec3(0, 0, 1), n = normalize((mg * cv).xyz);
    vec3 weights = vec3(1.0, max(dot(n, l), 0.0), pow(max(dot(n, normalize(l + v)), 0.0), 80.0));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 3; i++) {
        int k = order[i];
        sum += weights[k] * material[k].rgb * light[k];
    }
    vc = vec4(sum, 1.0);
    gl_Position = mc * pv;
}
