#version 330 core

struct Material { sampler2D weave; sampler2D maps[2]; float gloss; };

in vec4 place;
uniform Material material;
uniform sampler2D label, lamps;
uniform samplerCube sky;
out vec4 colour;

void main()
{
    vec3 normal = texture(material.maps[0], place.xy).xyz * 2.0 - 1.0;
    vec3 cloth = texture(material.weave, place.xy * 2.0).rgb * texture(material.maps[1], place.xy).r;
    vec4 sign = texture(label, place.xy * 1.5 - 0.25);
    vec3 lit = texture(lamps, place.xy * 0.5).rgb * 0.125;
    vec3 around = texture(sky, vec3(place.xy - 0.5, place.z) + normal * material.gloss).rgb;
    colour = vec4(mix(cloth, sign.rgb, 0.4 * sign.a) * normal.z + lit * 0.3 + around * 0.2, 1.0);
}
