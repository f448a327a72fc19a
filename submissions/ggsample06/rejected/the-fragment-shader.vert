#version 410 core

// ラスタライザから受け取る頂点属性の補間値
in vec4 vc;

// フレームバッファに出力するデータ
out vec4 fc;

void main(void)
{
  fc = vc;
}
