#version 330 core

in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;

out Surface
{
  vec3 point;
  vec3 upright;
} surface;

void main()
{
  vec4 eye = mw * pv;
  surface.point = eye.xyz / eye.w;
  surface.upright = mat3(mg) * cv.xyz;
  gl_Position = mc * pv;
}
