#version 330 core
in vec3 mesh_position;

void main()
{
    gl_Position = vec4(mesh_position, 1.0);
}
