#version 410 core

// ラスタライザから受け取る頂点属性の補間値
in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 t;
uniform sampler2DShadow depth;

// フレームバッファに出力するデータ
layout (location = 0) out vec4 fc;

void main(void)
{
  fc = (iamb + idiff + ispec) * textureProj(depth, t);
}
