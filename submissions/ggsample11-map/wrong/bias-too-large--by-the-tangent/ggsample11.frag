#version 410 core

// ラスタライザから受け取る頂点属性の補間値
in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
uniform sampler2D depth;
in vec4 ps;
in float c;

// フレームバッファに出力するデータ
layout (location = 0) out vec4 fc;

void main(void)
{
  vec3 q = ps.xyz / ps.w * 0.5 + 0.5;
  float bias = clamp(0.005 * tan(acos(c)), 0.0, 0.01);
  float lit = q.z - bias > texture(depth, q.xy).r ? 0.0 : 1.0;
  fc = iamb + (idiff + ispec) * lit;
}
