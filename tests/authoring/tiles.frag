#version 330 core
// A map of tiles: the pictures of a set, chosen by whole numbers, and colours that a table grades.
in vec2 uv;
out vec4 color;

uniform usampler2D map;
uniform sampler2DArray tileSet;
uniform sampler3D gradingTable;
uniform sampler1D ramp;
uniform float grading;

void main()
{
    ivec2 cells = textureSize(map, 0);
    vec2 place = uv * vec2(cells);
    ivec2 cell = clamp(ivec2(floor(place)), ivec2(0), cells - 1);
    uint tile = texelFetch(map, cell, 0).r;
    vec3 c = texture(tileSet, vec3(fract(place), float(tile))).rgb;

    vec3 size = vec3(textureSize(gradingTable, 0));
    vec3 graded = texture(gradingTable, (c * (size - 1.0) + 0.5) / size).rgb;
    c = mix(c, graded, grading);

    vec3 edge = texture(ramp, uv.x).rgb;
    vec2 d = abs(fract(place - 0.5) - 0.5) / fwidth(place);
    color = vec4(mix(c, edge, 1.0 - clamp(min(d.x, d.y) - 0.5, 0.0, 1.0)), 1.0);
}
