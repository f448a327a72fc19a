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


// 反射ベクトルを使った鏡面反射
float phong(vec3 n, vec3 l, vec3 v)
{
  if (dot(n, l) < 0.0) return 0.0;
  vec3 r = 2.0 * dot(n, l) * n - l;
  return pow(max(dot(r, v), 0.0), u_material.shininess);
}

void main()
{
  mat4 toEye = u_viewMatrix * u_modelMatrix;
  mat3 nm = transpose(inverse(mat3(toEye)));
  vec4 pos4 = toEye * vec4(a_position, 1.0);
  vec4 lamp4 = u_viewMatrix * vec4(u_lightPos, 1.0);
  vec3 n = normalize(nm * a_normal);
  vec3 l = normalize(lamp4.xyz - pos4.xyz);
  vec3 v = normalize(-pos4.xyz);
  vec4 sum = u_material.ambient * u_lightMaterial.ambient;
  sum += 1.0 / dot(lamp4.xyz - pos4.xyz, lamp4.xyz - pos4.xyz) * max(dot(l, n), 0.0) * u_material.diffuse * u_lightMaterial.diffuse;
  sum += phong(n, l, v) * u_material.specular * u_lightMaterial.specular;
  v_color = sum;
  gl_Position = u_projectionMatrix * pos4;
}
