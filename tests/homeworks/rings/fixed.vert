#version 330 core
in vec3 position;
out vec2 share;
void main()
{
  // Where in the window it is, from 0 to 1.
  share = 0.5 + 0.5 * position.xy;
  gl_Position = vec4(position, 1.0);
}
