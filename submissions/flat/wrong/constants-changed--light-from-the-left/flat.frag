#version 410 core

//
// flat.frag: フラットシェーディングのフラグメントシェーダ / flat shading, fragment shader
//

// ラスタライザから受け取る色 / colour from the rasteriser
flat in vec4 vc;

// フレームバッファに出力する色 / colour for the frame buffer
layout (location = 0) out vec4 fc;

void main(void)
{
  fc = vc;
}
