#version 410 core

// ラスタライザから受け取る頂点属性の補間値
in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
uniform sampler2DShadow depth;
in vec4 ps;

// フレームバッファに出力するデータ
layout (location = 0) out vec4 fc;

void main(void)
{
  vec4 c = ps;
  c.z -= 0.2;
  vec3 q = c.xyz / c.w * 0.5 + 0.5;
  fc = iamb + (idiff + ispec) * texture(depth, q);
}
