#version 420 core
layout(location = 0) out vec4 result;
struct Material { sampler2D base; sampler2D gloss; float shine; };
struct Lamp { vec3 position, colour; };
uniform Material material;
uniform Lamp lamps[2];
uniform vec3 eye;
in vec3 facing; in vec2 at_texture; in vec3 at;
vec3 one(const in Lamp lamp, in vec3 n, in vec3 v, vec4 tex)
{
    vec3 l = lamp.position - at; l *= inversesqrt(dot(l, l));
    vec3 h = normalize(l + v);
    float d = clamp(dot(n, l), 0.0, 1.0), s = exp(material.shine * log(max(dot(n, h), 1e-30)));
    return lamp.colour * (tex.rgb * d + tex.a * s);
}
void main(void)
{
    vec3 n = facing * inversesqrt(dot(facing, facing));
    vec3 v = normalize(eye - at);
    vec4 tex = vec4(texture(material.base, at_texture).rgb, texture(material.gloss, at_texture).r);
    result.a = 0.5;
    if (!gl_FrontFacing) discard; result.rgb = tex.rgb * 0.15;
    int i = 0;
    do { result.rgb += one(lamps[i], n, v, tex); i++; } while (i < lamps.length());
}
