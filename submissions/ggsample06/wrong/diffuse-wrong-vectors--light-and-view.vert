#version 410 core

// light
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);     // position
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);   // ambient
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);  // diffuse
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);  // specular

// material
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;

layout (location = 0) in vec4 pv;  // position
in vec4 cv;                        // normal

uniform mat4 mw;  // model-view
uniform mat4 mc;  // model-view-projection
uniform mat4 mg;  // normal matrix

out vec4 vc;

void main() {
    vec4 p = mw * pv;
    vec3 v = -normalize(p.xyz / p.w);
    vec3 l = normalize((pl * p.w - p * pl.w).xyz);
    vec3 n = normalize((mg * cv).xyz);
    vec3 h = normalize(l + v);

    vec4 ambient = lamb * kamb;
    float lambert = max(dot(l, v), 0.0);
    vec4 diffuse = lambert * ldiff * kdiff;
    float blinn = pow(max(dot(n, h), 0.0), kshi);
    vec4 specular = blinn * lspec * kspec;

    vc = ambient + diffuse + specular;
    gl_Position = mc * pv;
}
