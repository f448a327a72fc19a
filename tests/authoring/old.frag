#version 150
in vec3 shade;
in vec2 place;
uniform int stripes;
void main()
{
    vec3 sum = 0.3 * shade;
    for (int i = 1; i <= stripes; i++) {
        sum += 0.1 * (0.5 + 0.5 * sin(8.0 * place.y * float(i)));
    }
    gl_FragColor = vec4(sum, 1.0);
}
