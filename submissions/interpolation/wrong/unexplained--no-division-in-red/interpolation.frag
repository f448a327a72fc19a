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

noperspective in vec3 q;
flat in vec2 corner;

vec2 bands(vec2 x)
{
  return vec2(0.5) - 0.5 * cos(x * count * 6.2831853);
}

void main(void)
{
  fc.rg = bands(vec2(q.x, q.z));
  fc.ba = vec2(corner.x, 1.0);
}
