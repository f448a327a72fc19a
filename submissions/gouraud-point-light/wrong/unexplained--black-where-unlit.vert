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

void main()
{
  mat4 mv = u_viewMatrix * u_modelMatrix;
  vec4 q = mv * vec4(a_position, 1.0);
  gl_Position = u_projectionMatrix * q;
  vec3 n = normalize(transpose(inverse(mat3(mv))) * a_normal);
  vec3 l = normalize((u_viewMatrix * vec4(u_lightPos, 1.0) - q).xyz);
  float nl = dot(n, l);
  if (nl < 0.0)
  {
    v_color = vec4(0.0, 0.0, 0.0, 1.0);
    return;
  }
  vec3 r = reflect(-l, n);
  v_color = u_lightMaterial.ambient * u_material.ambient
          + nl * u_lightMaterial.diffuse * u_material.diffuse
          + pow(max(dot(r, normalize(-q.xyz)), 0.0), u_material.shininess) * u_lightMaterial.specular * u_material.specular;
}
