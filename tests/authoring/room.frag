#version 330 core
// Reflections in a room: the cube map was taken at `probePos`, so the reflected ray is cut with the walls of the room first.
in vec3 wPos;
in vec3 wNormal;
out vec4 fragColor;

uniform samplerCube roomMap;
uniform vec3 boxMin;
uniform vec3 boxMax;
uniform vec3 probePos;
uniform vec3 camPos;
uniform vec3 baseColor;
uniform float metalness;

vec3 parallaxCorrected(vec3 r)
{
    vec3 toMax = (boxMax - wPos) / r;
    vec3 toMin = (boxMin - wPos) / r;
    vec3 farthest = max(toMax, toMin);
    float distance = min(min(farthest.x, farthest.y), farthest.z);
    return wPos + distance * r - probePos;
}

void main()
{
    vec3 n = normalize(wNormal);
    vec3 v = normalize(camPos - wPos);
    vec3 r = reflect(-v, n);
    vec3 f0 = mix(vec3(0.04), baseColor, metalness);
    vec3 fresnel = f0 + (1.0 - f0) * pow(1.0 - max(dot(n, v), 0.0), 5.0);
    vec3 mirrored = textureLod(roomMap, parallaxCorrected(r), 0.0).rgb;
    vec3 diffuse = baseColor * (1.0 - metalness) * texture(roomMap, n).rgb;
    fragColor = vec4(diffuse * (1.0 - fresnel) + mirrored * fresnel, 1.0);
}
