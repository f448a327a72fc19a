#version 410 core

//
// interpolation.frag: 補間の方法の指定 (フラグメントシェーダ) / interpolation qualifiers, fragment shader
//

// 縞の数 / number of stripes
const float count = 6.0;

// 頂点シェーダから受け取るものを, ここで宣言してください.
// Declare here what comes from the vertex shader.

// フレームバッファに出力する色 / colour for the frame buffer
layout (location = 0) out vec4 fc;

// 座標 c での縞の明るさ / brightness of the stripes at coordinate c
float stripes(float c)
{
  return 0.5 - 0.5 * cos(6.2831853 * count * c);
}

void main(void)
{
  // 次の 3 行を書き換えてください.
  // 赤: 透視補正をした座標の縞, 緑: 透視補正をしない (画面上で線形な) 座標の縞, 青: 三角形の最後の頂点の座標そのもの
  // Replace the next three lines.
  // Red: stripes of the coordinate with perspective. Green: stripes of the coordinate that is linear on the screen.
  // Blue: the coordinate of the triangle's last vertex as it is.
  float red = 0.5;
  float green = 0.5;
  float blue = 0.5;
  fc = vec4(red, green, blue, 1.0);
}
