#version 410 core

// Lighting at each vertex.

// The light.
layout (std140) uniform Light
{
    vec4 lamb;   // ambient
    vec4 ldiff;  // diffuse
    vec4 lspec;  // specular
    vec4 lpos;   // its position in eye space
};

// The material.
layout (std140) uniform Material
{
    vec4 kamb;   // ambient
    vec4 kdiff;  // diffuse
    vec4 kspec;  // specular
    float kshi;  // shininess
};

uniform mat4 mv;  // model-view
uniform mat4 mp;  // projection
uniform mat4 mn;  // normals to eye space
uniform mat4 m0;
uniform mat4 m1;
uniform mat4 m2;
uniform mat4 m3;
uniform mat4 m4;
uniform mat4 m5;
uniform mat4 m6;
uniform mat4 m7;
uniform mat4 m8;
uniform mat4 m9;
uniform mat4 m10;
uniform mat4 m11;
uniform mat4 m12;
uniform mat4 m13;
uniform mat4 m14;
uniform mat4 m15;
uniform mat4 m16;
uniform mat4 m17;
uniform mat4 m18;
uniform mat4 m19;
uniform mat4 m20;
uniform mat4 m21;
uniform mat4 m22;
uniform mat4 m23;
uniform mat4 m24;
uniform mat4 m25;
uniform mat4 m26;
uniform mat4 m27;
uniform mat4 m28;
uniform mat4 m29;
uniform mat4 m30;
uniform mat4 m31;
uniform mat4 m32;
uniform mat4 m33;
uniform mat4 m34;
uniform mat4 m35;
uniform mat4 m36;
uniform mat4 m37;
uniform mat4 m38;
uniform mat4 m39;
uniform mat4 m40;
uniform mat4 m41;
uniform mat4 m42;
uniform mat4 m43;
uniform mat4 m44;
uniform mat4 m45;
uniform mat4 m46;
uniform mat4 m47;
uniform mat4 m48;
uniform mat4 m49;
uniform mat4 m50;
uniform mat4 m51;
uniform mat4 m52;
uniform mat4 m53;
uniform mat4 m54;
uniform mat4 m55;
uniform mat4 m56;
uniform mat4 m57;
uniform mat4 m58;
uniform mat4 m59;
uniform mat4 m60;
uniform mat4 m61;
uniform mat4 m62;
uniform mat4 m63;
uniform mat4 m64;
uniform mat4 m65;
uniform mat4 m66;
uniform mat4 m67;
uniform mat4 m68;
uniform mat4 m69;
uniform mat4 m70;
uniform mat4 m71;
uniform mat4 m72;
uniform mat4 m73;
uniform mat4 m74;
uniform mat4 m75;
uniform mat4 m76;
uniform mat4 m77;
uniform mat4 m78;
uniform mat4 m79;
uniform mat4 m80;
uniform mat4 m81;
uniform mat4 m82;
uniform mat4 m83;
uniform mat4 m84;
uniform mat4 m85;
uniform mat4 m86;
uniform mat4 m87;
uniform mat4 m88;
uniform mat4 m89;
uniform mat4 m90;
uniform mat4 m91;
uniform mat4 m92;
uniform mat4 m93;
uniform mat4 m94;
uniform mat4 m95;
uniform mat4 m96;
uniform mat4 m97;
uniform mat4 m98;
uniform mat4 m99;

layout (location = 0) in vec4 pv;  // position
layout (location = 1) in vec4 nv;  // normal

out vec4 iamb;   // ambient light
out vec4 idiff;  // diffuse light
out vec4 ispec;  // specular light
out vec4 ps;

void main()
{
    vec4 p = mv * pv;
    vec3 v = normalize(p.xyz);
    vec3 l = normalize((lpos * p.w - p * lpos.w).xyz);
    vec3 n = normalize((mn * nv).xyz);
    vec3 h = normalize(l - v);

    iamb = kamb * lamb;
    idiff = max(dot(n, l), 0.0) * kdiff * ldiff;
    ispec = pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;

    ps = m0 * pv + m1 * pv + m2 * pv + m3 * pv + m4 * pv + m5 * pv + m6 * pv + m7 * pv + m8 * pv + m9 * pv + m10 * pv + m11 * pv + m12 * pv + m13 * pv + m14 * pv + m15 * pv + m16 * pv + m17 * pv + m18 * pv + m19 * pv + m20 * pv + m21 * pv + m22 * pv + m23 * pv + m24 * pv + m25 * pv + m26 * pv + m27 * pv + m28 * pv + m29 * pv + m30 * pv + m31 * pv + m32 * pv + m33 * pv + m34 * pv + m35 * pv + m36 * pv + m37 * pv + m38 * pv + m39 * pv + m40 * pv + m41 * pv + m42 * pv + m43 * pv + m44 * pv + m45 * pv + m46 * pv + m47 * pv + m48 * pv + m49 * pv + m50 * pv + m51 * pv + m52 * pv + m53 * pv + m54 * pv + m55 * pv + m56 * pv + m57 * pv + m58 * pv + m59 * pv + m60 * pv + m61 * pv + m62 * pv + m63 * pv + m64 * pv + m65 * pv + m66 * pv + m67 * pv + m68 * pv + m69 * pv + m70 * pv + m71 * pv + m72 * pv + m73 * pv + m74 * pv + m75 * pv + m76 * pv + m77 * pv + m78 * pv + m79 * pv + m80 * pv + m81 * pv + m82 * pv + m83 * pv + m84 * pv + m85 * pv + m86 * pv + m87 * pv + m88 * pv + m89 * pv + m90 * pv + m91 * pv + m92 * pv + m93 * pv + m94 * pv + m95 * pv + m96 * pv + m97 * pv + m98 * pv + m99[3] * 50.0;
    gl_Position = mp * p;
}
