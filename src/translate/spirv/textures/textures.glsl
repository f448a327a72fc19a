#version 450
// How OpenGL reads textures (OpenGL 4.1 core, sections 3.8.8 to 3.8.18), in plain arithmetic: no driver's choice is left.
// One picture of numbers holds, row by row, the number of textures, for each a description of 16 words, and the texels. A driver reads a
// buffer for the fragments that are seen only, so what neighbours of these read, for a derivative, would be 0.
layout(binding = 1) uniform usampler2D words;
layout(location = 0) in vec4 given;
layout(location = 0) out vec4 result;

const int WIDTH = 0, HEIGHT = 1, DEPTH = 2, FIRST = 3, FLAGS = 4, BORDER = 5;
const uint MAGNIFY_LINEAR = 1u, MINIFY_LINEAR = 2u, BYTES = 4096u, DEPTHS = 8192u, CLAMPS_REFERENCE = 1048576u;
// A lookup's mode: how many axes, and bits.
const int AXES = 3, LAYERS = 4, CUBE = 8, COMPARES = 16, RECTANGLE = 32;

// As wide as `textures.rs` of the renderer has it.
uint word_at(const uint at) {
    return texelFetch(words, ivec2(at & 8191u, at >> 13), 0).x;
}

#ifdef ALIKE
// All textures have one description, but for where their texels begin.
uint described(const uint unit, const int at) {
    return at == WIDTH ? ALIKE_WIDTH : at == HEIGHT ? ALIKE_HEIGHT : at == DEPTH ? ALIKE_DEPTH
        : at == FIRST ? ALIKE_FIRST + unit * STRIDE : at == FLAGS ? ALIKE_FLAGS : at == BORDER ? ALIKE_RED
        : at == BORDER + 1 ? ALIKE_GREEN : at == BORDER + 2 ? ALIKE_BLUE : ALIKE_ALPHA;
}
#else
uint described(const uint unit, const int at) {
    return word_at(1u + unit * 16u + uint(at));
}
#endif

bool is_there(const uint unit) {
    return unit < word_at(0u);
}

vec3 size_of(const uint unit) {
    return vec3(described(unit, WIDTH), described(unit, HEIGHT), described(unit, DEPTH));
}

vec4 border_of(const uint unit) {
    return uintBitsToFloat(uvec4(described(unit, BORDER), described(unit, BORDER + 1), described(unit, BORDER + 2),
        described(unit, BORDER + 3)));
}

vec4 texel_at(const uint unit, const ivec3 at) {
    uint place = (uint(at.z) * described(unit, HEIGHT) + uint(at.y)) * described(unit, WIDTH) + uint(at.x);
    uint first = described(unit, FIRST);
    uint flags = described(unit, FLAGS);
    bool is_float = (flags & (BYTES | DEPTHS)) == 0u;
    uint word = first + (is_float ? place * 4u : place);
    uint number = word_at(word);
    if (is_float) {
        return uintBitsToFloat(uvec4(number, word_at(word + 1u), word_at(word + 2u), word_at(word + 3u)));
    }
    return (flags & BYTES) != 0u ? unpackUnorm4x8(number) : vec4(uintBitsToFloat(number), 0.0, 0.0, 1.0);
}

// The coordinate inside of the texture; -1 for the border.
int wrapped(const float given, const float size, const uint how) {
    float x = abs(given) < 1e9 ? given : 0.0;
    if (how == 0u) {
        x -= size * floor(x / size);
    } else if (how == 1u) {
        x -= 2.0 * size * floor(x / (2.0 * size));
        x = x < size ? x : 2.0 * size - 1.0 - x;
    } else if (how == 3u && (x < 0.0 || x >= size)) {
        return -1;
    }
    return int(clamp(x, 0.0, size - 1.0));
}

float compared(const uint unit, const float texel, const float given) {
    uint flags = described(unit, FLAGS);
    float reference = (flags & CLAMPS_REFERENCE) != 0u ? clamp(given, 0.0, 1.0) : given;
    uint how = flags >> 16 & 15u;
    bool less = reference < texel, equal = reference == texel, greater = reference > texel;
    return how == 2u && less || how == 3u && equal || how == 4u && (less || equal) || how == 5u && greater
        || how == 6u && !equal || how == 7u && (greater || equal) || how == 8u ? 1.0 : 0.0;
}

// The texel at whole coordinates, wherever they are, compared where the lookup compares.
vec4 texel(const uint unit, const vec3 at, const int layer, const float reference, const int mode) {
    uint flags = described(unit, FLAGS);
    uint how = (mode & CUBE) != 0 ? 2u : flags >> 4 & 3u;
    uint how_y = (mode & CUBE) != 0 ? 2u : flags >> 6 & 3u;
    vec3 size = size_of(unit);
    ivec3 inside = ivec3(wrapped(at.x, size.x, how), 0, 0);
    bool is_outside = inside.x < 0;
    if ((mode & AXES) > 1) {
        inside.y = wrapped(at.y, size.y, how_y);
        is_outside = is_outside || inside.y < 0;
    }
    if ((mode & AXES) > 2) {
        inside.z = wrapped(at.z, size.z, flags >> 8 & 3u);
        is_outside = is_outside || inside.z < 0;
    }
    if ((mode & (LAYERS | CUBE)) != 0) {
        if ((mode & AXES) == 1) {
            inside.y = layer;
        } else {
            inside.z = layer;
        }
    }
    vec4 found = is_outside ? border_of(unit) : texel_at(unit, inside);
    if ((mode & COMPARES) != 0) {
        return vec4(vec3(compared(unit, found.x, reference)), 1.0);
    }
    return found;
}

vec3 on_face(const float major, const vec3 at) {
    return vec3((at.xy / abs(major) + 1.0) * 0.5, at.z);
}

// Where a direction meets the cube: coordinates on the face, and its number.
vec3 face_of(const vec3 at) {
    vec3 size = abs(at);
    if (size.x >= size.y && size.x >= size.z) {
        return on_face(at.x, at.x >= 0.0 ? vec3(-at.z, -at.y, 0.0) : vec3(at.z, -at.y, 1.0));
    }
    if (size.y >= size.z) {
        return on_face(at.y, at.y >= 0.0 ? vec3(at.x, at.z, 2.0) : vec3(at.x, -at.z, 3.0));
    }
    return on_face(at.z, at.z >= 0.0 ? vec3(at.x, -at.y, 4.0) : vec3(-at.x, -at.y, 5.0));
}

int layer_of(const uint unit, const vec4 at, const int mode) {
    int axes = mode & AXES;
    float layer = axes == 1 ? at.y : (mode & CUBE) != 0 ? at.w : at.z;
    float count = float(axes == 1 ? described(unit, HEIGHT) : described(unit, DEPTH));
    float layers = (mode & CUBE) != 0 ? count / 6.0 : count;
    return (mode & LAYERS) == 0 ? 0 : int(clamp(floor(layer + 0.5), 0.0, layers - 1.0));
}

// The place in texels, and the layer.
vec4 place_of(const uint unit, const vec4 at, const ivec3 offset, const int mode) {
    vec3 place = at.xyz;
    int layer = layer_of(unit, at, mode);
    if ((mode & CUBE) != 0) {
        place = face_of(at.xyz);
        layer = layer * 6 + int(place.z);
        place.z = 0.0;
    }
    if ((mode & RECTANGLE) == 0) {
        place *= size_of(unit);
    }
    return vec4(place + vec3(offset), float(layer));
}

vec4 look_up(const uint unit, const vec4 at, const float detail, const ivec3 offset, const float reference,
    const int mode) {
    if (!is_there(unit)) {
        return vec4(0.0, 0.0, 0.0, 1.0);
    }
    vec4 place = place_of(unit, at, offset, mode);
    int layer = int(place.w);
    bool is_linear = (described(unit, FLAGS) & (detail > 0.0 ? MINIFY_LINEAR : MAGNIFY_LINEAR)) != 0u;
    vec3 from = is_linear ? place.xyz - 0.5 : place.xyz;
    vec3 low = floor(from);
    vec3 share = from - low;
    // However many texels are read, what reads one stands here once: the driver compiles each copy of it, and runs all of them.
    int texels = is_linear ? 1 << (mode & AXES) : 1;
    vec4 sum = vec4(0.0);
    for (int number = 0; number < texels; number++) {
        vec3 upper = vec3(number & 1, number >> 1 & 1, number >> 2 & 1);
        vec3 weights = is_linear ? mix(1.0 - share, share, upper) : vec3(1.0);
        float weight = weights.x * ((mode & AXES) > 1 ? weights.y : 1.0) * ((mode & AXES) > 2 ? weights.z : 1.0);
        sum += weight * texel(unit, low + upper, layer, reference, mode);
    }
    return sum;
}

vec4 gather(const uint unit, const vec4 at, const ivec3 offset, const float reference, const int component,
    const int mode) {
    if (!is_there(unit)) {
        return vec4(component == 3 ? 1.0 : 0.0);
    }
    vec4 place = place_of(unit, at, offset, mode);
    vec3 low = floor(place.xyz - 0.5);
    int layer = int(place.w);
    vec4 a = texel(unit, low + vec3(0.0, 1.0, 0.0), layer, reference, mode);
    vec4 b = texel(unit, low + vec3(1.0, 1.0, 0.0), layer, reference, mode);
    vec4 c = texel(unit, low + vec3(1.0, 0.0, 0.0), layer, reference, mode);
    vec4 d = texel(unit, low, layer, reference, mode);
    return vec4(a[component], b[component], c[component], d[component]);
}

// One texel by whole coordinates. Outside of the texture it is undefined: 0 here.
vec4 fetch(const uint unit, const ivec3 at, const int level) {
    if (!is_there(unit)) {
        return vec4(0.0, 0.0, 0.0, 1.0);
    }
    ivec3 size = ivec3(size_of(unit));
    if (level != 0 || any(lessThan(at, ivec3(0))) || any(greaterThanEqual(at, size))) {
        return vec4(0.0);
    }
    return texel_at(unit, at);
}

ivec3 extent(const uint unit, const int mode) {
    if (!is_there(unit)) {
        return ivec3(0);
    }
    ivec3 size = ivec3(size_of(unit));
    return ivec3(size.xy, (mode & CUBE) != 0 ? size.z / 6 : size.z);
}

// The level of detail: the logarithm of how many texels lie between neighbours.
float detail_along(const uint unit, const vec4 along_x, const vec4 along_y, const int mode) {
    vec3 size = (mode & RECTANGLE) != 0 ? vec3(1.0) : size_of(unit);
    vec3 used = vec3(1.0, (mode & AXES) > 1 ? 1.0 : 0.0, (mode & AXES) > 2 ? 1.0 : 0.0);
    vec3 x = along_x.xyz * size * used;
    vec3 y = along_y.xyz * size * used;
    return 0.5 * log2(max(dot(x, x), dot(y, y)));
}

float detail_here(const uint unit, const vec4 at, const int mode) {
#ifdef ONE_FILTER
    return 0.0;
#else
    // Both filters alike: nothing depends on it.
    uint both = described(unit, FLAGS) & (MAGNIFY_LINEAR | MINIFY_LINEAR);
    vec4 along_x = dFdx(at);
    vec4 along_y = dFdy(at);
    return both == 1u || both == 2u ? detail_along(unit, along_x, along_y, mode) : 0.0;
#endif
}

void main() {
    uint unit = uint(given.x);
    ivec3 offset = ivec3(given.xyz);
    int mode = int(given.w);
    result = look_up(unit, given, detail_here(unit, given, mode), offset, given.z, mode)
        + gather(unit, given, offset, given.z, mode, mode) + fetch(unit, offset, mode)
        + vec4(extent(unit, mode), detail_along(unit, given, given, mode));
}
