#version 330 core
in vec3 position;
in vec2 uv;
uniform mat4 model, view, projection;
uniform float time, amplitude;
out vec3 paint;
void main()
{
    float far = float(gl_InstanceID);
    vec3 p = position;
    p.y += amplitude * sin(3.0 * p.x + time + far) + 0.4 * far;
    paint = vec3(uv, 0.25 * far);
    gl_Position = projection * view * model * vec4(p, 1.0);
}
