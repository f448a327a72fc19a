#version 410 core

uniform sampler2DShadow depth;  // デプスマップ

// ラスタライザから受け取る頂点属性の補間値
in vec4 iamb;   // 環境光の反射光強度
in vec4 idiff;  // 拡散反射光強度
in vec4 ispec;  // 鏡面反射光強度
in vec4 ps;

// フレームバッファに出力するデータ
layout (location = 0) out vec4 fc;  // フラグメントの色
#define S(x, y) s += textureProj(depth, ps + vec4(x, y, 0.0, 0.0) / 800.0 * ps.w);

void main()
{
  float s = 0.0;
  S(-1.5, -1.5) S(-0.5, -1.5) S(0.5, -1.5) S(1.5, -1.5)
  S(-1.5, -0.5) S(-0.5, -0.5) S(0.5, -0.5) S(1.5, -0.5)
  S(-1.5, 0.5) S(-0.5, 0.5) S(0.5, 0.5) S(1.5, 0.5)
  S(-1.5, 1.5) S(-0.5, 1.5) S(0.5, 1.5) S(1.5, 1.5)
  fc = iamb + (idiff + ispec) * s / 16.0;
}
