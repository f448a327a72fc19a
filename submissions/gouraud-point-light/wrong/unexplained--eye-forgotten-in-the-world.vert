#version 330

//
// gouraud.vert: 点光源によるグーローシェーディング / Gouraud shading with a point light
//

// 光または材質のパラメータ / parameters of a light or a material
struct MaterialParam
{
  vec4 ambient;                                 // 環境光の強度, 反射係数 / ambient: intensity, reflectance
  vec4 diffuse;                                 // 拡散反射光の強度, 拡散反射係数 / diffuse: intensity, reflectance
  vec4 specular;                                // 鏡面反射光の強度, 鏡面反射係数 / specular: intensity, reflectance
  float shininess;                              // 輝き係数 (材質のみ) / shininess (of the material only)
};

// 光源と材質 / light and material
uniform vec3 u_lightPos;                        // 点光源の位置 (ワールド座標系) / position of the point light (world space)
uniform MaterialParam u_lightMaterial;          // 光源の強度 / intensities of the light
uniform MaterialParam u_material;               // 材質の反射係数 / reflectances of the material

// 変換行列 / matrices
uniform mat4 u_modelMatrix;                     // モデル変換行列 / object to world space
uniform mat4 u_viewMatrix;                      // ビュー変換行列 / world to eye space
uniform mat4 u_projectionMatrix;                // 投影変換行列 / eye to clip space

// 頂点属性 / vertex attributes
in vec3 a_position;                             // ローカル座標系の頂点位置 / position in object space
in vec3 a_normal;                               // ローカル座標系の法線ベクトル / normal in object space

// ラスタライザに送る頂点の色 / vertex colour for the rasteriser
out vec4 v_color;

vec3 worldNormal()
{
  mat3 m = mat3(u_modelMatrix);
  mat3 cof = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
  return normalize(cof * a_normal);
}

void main()
{
  vec3 P = (u_modelMatrix * vec4(a_position, 1.0)).xyz;
  vec3 eye = (inverse(u_viewMatrix) * vec4(0.0, 0.0, 0.0, 1.0)).xyz;
  vec3 N = worldNormal();
  vec3 toLamp = normalize(u_lightPos - P);
  vec3 toEye = normalize(-P);
  float a = dot(N, toLamp);
  vec3 rgb = u_material.ambient.rgb * u_lightMaterial.ambient.rgb;
  if (a > 0.0) {
    rgb += a * u_material.diffuse.rgb * u_lightMaterial.diffuse.rgb;
    float b = dot(2.0 * a * N - toLamp, toEye);
    if (b > 0.0)
      rgb += pow(b, u_material.shininess) * u_material.specular.rgb * u_lightMaterial.specular.rgb;
  }
  v_color = vec4(rgb, 1.0);
  gl_Position = u_projectionMatrix * (u_viewMatrix * vec4(P, 1.0));
}
