#version 420 core
// Lamps of a block, each of a kind and switched on or off.
struct Lamp {
    vec4 place;
    vec3 colour;
    int kind;
    bool isOn;
};

layout(std140, binding = 2) uniform Workshop {
    Lamp lamps[3];
    float sharpness;
};

in vec3 worldPos;
in vec3 worldNormal;
out vec4 result;

void main()
{
    vec3 n = normalize(worldNormal);
    vec3 light = vec3(0.05);
    for (int i = 0; i < 3; ++i) {
        Lamp lamp = lamps[i];
        if (!lamp.isOn)
            continue;
        vec3 l = normalize(lamp.place.xyz - worldPos);
        float strength = 1.0;
        switch (lamp.kind) {
        case 0:
            strength = max(dot(n, l), 0.0);
            break;
        case 1:
            strength = 0.5 + 0.5 * dot(n, l);
            break;
        case 2:
            strength = pow(max(dot(n, l), 0.0), sharpness);
            break;
        }
        light += lamp.colour * strength;
    }
    result = vec4(light, 1.0);
}
