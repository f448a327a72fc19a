#version 410 core
uniform sampler2D D;
in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 lp;
layout (location = 0) out vec4 fc;
void main()
{
    float x = (lp.x / lp.w + 1.0) / 2.0;
    float y = (lp.y / lp.w + 1.0) / 2.0;
    float z = (lp.z / lp.w + 1.0) / 2.0;
    float nearest = texture(D, vec2(x, y)).r;
    float k = step(z, nearest + 0.001);
    vec4 direct = idiff + ispec;
    fc = mix(iamb, direct, k);
}
