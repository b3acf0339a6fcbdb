#version 300 es
// A piece of a hair between two points, as a ribbon that faces the eye, with the light that it sends there.
precision highp float;
precision highp sampler3D;

// Position (m), half the width (m).
layout(location = 0) in vec4 start;
layout(location = 1) in vec4 end;
// Direction; w: 0 at a tip, which has no next point.
layout(location = 2) in vec4 start_tangent;
layout(location = 3) in vec4 end_tangent;
// Colour of much hair (sRGB); w: a number of the strand.
layout(location = 4) in vec4 start_colour;
layout(location = 5) in vec4 end_colour;

uniform vec3 eye, right, above, forward;
uniform vec2 size, shift;
// Pixels per unit of slope; nearest and farthest depth (m).
uniform vec3 lens;
// Divisions of a piece, factor on widths, number of the picture.
uniform vec3 shape;
// The grid of light: low corner (m), one over its sides (1/m).
uniform vec3 low, cells;
uniform sampler3D seen;
uniform vec3 lamps[3], lamp_light[3], sky;

out vec3 light;
flat out float cover;
flat out float seed;

const float PI = 3.14159265;

float gaussian(float x, float width) {
    float u = x / width;
    return exp(-0.5 * u * u) / (width * 2.50662827);
}

vec3 linear(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
}

// What a fibre does with light, from the colour of much hair like it: the absorption is the inverse of the fit of [Chiang et
// al. 2016], "A practical and controllable hair and fur model", for an azimuthal roughness of 0.3.
struct Fibre { vec3 diffuse; float reflected; vec3 transmitted; vec3 returned; };

Fibre matter(vec3 colour) {
    vec3 root = log(max(colour, 1e-4)) / 5.85;
    vec3 absorbed = exp(-1.7 * root * root);
    return Fibre(1.12 * colour + 0.002, 0.045, 0.5 * absorbed, 0.06 * absorbed * absorbed);
}

// Light of a lamp: lobes along the fibre after [Marschner et al. 2003] and diffuse light after [Kajiya & Kay 1989].
vec3 from_lamp(vec3 t, vec3 to_eye, vec3 to_light, Fibre m, float straight, float turned) {
    float sl = clamp(dot(t, to_light), -1.0, 1.0), se = clamp(dot(t, to_eye), -1.0, 1.0);
    float across = sqrt(max((1.0 - sl * sl) * (1.0 - se * se), 1e-8));
    float cos_phi = clamp((dot(to_light, to_eye) - sl * se) / across, -1.0, 1.0);
    float sum = asin(sl) + asin(se) + turned, caught = sqrt(max(1.0 - sl * sl, 0.0));
    float r = caught * gaussian(sum + 0.1, 0.12) * 0.25 * cos(0.5 * acos(cos_phi));
    float tt = caught * gaussian(sum - 0.05, 0.07) * gaussian(PI - acos(cos_phi), 0.35);
    float trt = caught * gaussian(sum - 0.2, 0.22) * (1.0 + cos_phi) / (2.0 * PI);
    vec3 passed = pow(vec3(max(straight, 1e-3)), 1.0 - m.transmitted);
    return passed * caught / PI * m.diffuse + 0.5 * (passed + straight) * (r * m.reflected + trt * m.returned)
        + straight * tt * m.transmitted;
}

void main() {
    float t = float(gl_VertexID >> 1) / shape.x, side = float(gl_VertexID & 1) * 2.0 - 1.0;
    vec3 a = start.xyz, b = end.xyz;
    float h = distance(a, b);
    vec3 u = h * start_tangent.xyz, v = h * end_tangent.xyz;
    // Hermite's curve.
    vec3 p = a + t * (u + t * (3.0 * (b - a) - 2.0 * u - v + t * (2.0 * (a - b) + u + v)));
    vec3 along = normalize(u + t * (6.0 * (b - a) - 4.0 * u - 2.0 * v + 3.0 * t * (2.0 * (a - b) + u + v)) + 1e-9);
    vec3 d = p - eye;
    float depth = dot(d, forward);
    vec2 on_picture = vec2(dot(d, right), dot(d, above)) * lens.x / depth;
    // The tangent on the picture.
    float rise = dot(along, forward);
    vec2 way = vec2(dot(along, right), dot(along, above)) - rise / depth * vec2(dot(d, right), dot(d, above));
    vec2 normal = length(way) > 1e-6 ? vec2(-way.y, way.x) / length(way) : vec2(1.0, 0.0);
    // Hairs thinner than a pixel are a pixel wide and drawn as often as they cover it.
    float width = 2.0 * mix(start.w, end.w, t) * shape.y * lens.x / max(depth, lens.y);
    float drawn = max(width, 1.0);
    cover = width / drawn;
    seed = fract(start_colour.w * 61.7 + shape.z * 0.618034);
    on_picture += 0.5 * side * drawn * normal + shift;

    vec3 to_eye = -normalize(d);
    float number = start_colour.w;
    float turned = 0.1 * (number - 0.5), strength = exp(0.7 * (fract(number * 37.1) - 0.5));
    Fibre m = matter(linear(mix(start_colour.rgb, end_colour.rgb, t)));
    m.reflected *= strength;
    vec4 open = texture(seen, (p - low) * cells);
    light = sky * open.w * (m.diffuse + 0.45 * m.reflected + m.returned);
    for (int k = 0; k < 3; k++) {
        light += lamp_light[k] * from_lamp(along, to_eye, lamps[k], m, open[k], turned);
    }

    // Depth is linear in one over it, as a perspective has it.
    float z = lens.z / (lens.z - lens.y) * (1.0 - lens.y / max(depth, lens.y));
    gl_Position = vec4(2.0 * on_picture / size, 2.0 * z - 1.0, 1.0);
    if (start_tangent.w <= 0.0 || h <= 0.0 || depth < lens.y) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
