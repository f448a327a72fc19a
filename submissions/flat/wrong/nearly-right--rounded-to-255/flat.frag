#version 410 core

//
// flat.frag: フラットシェーディングのフラグメントシェーダ / flat shading, fragment shader
//

// ラスタライザから受け取る色 / colour from the rasteriser
flat in vec4 ambientPart;
flat in vec4 diffusePart;
flat in vec4 specularPart;

// フレームバッファに出力する色 / colour for the frame buffer
layout (location = 0) out vec4 fc;

void main(void)
{
  vec4 sum = ambientPart;
  sum += diffusePart;
  sum += specularPart;
  fc = floor(sum * 255.0) / 255.0;
}
