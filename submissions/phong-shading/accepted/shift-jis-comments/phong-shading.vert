#version 410 core

layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

out vec4 position;
out vec3 normal;

// 画素ごとの陰影付け（表・能・ソ）
void main(void)
{
  position = mw * pv;
  normal = normalize((mg * cv).xyz);
  gl_Position = mc * pv;
}
