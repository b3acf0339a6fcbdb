#version 300 es
precision highp float;
precision highp sampler3D;

in vec3 p;
in vec3 n;
out vec4 colour;

uniform vec3 eye, low, cells;
uniform sampler3D seen;
uniform vec3 lamps[3], lamp_light[3], sky;

const vec3 SKIN = vec3(0.40, 0.29, 0.235);

vec3 shown(vec3 c) {
    vec3 over = max(c - 0.55, 0.0);
    c = min(c, 0.55) + 0.45 * over / (over + 0.45);
    return mix(12.92 * c, 1.055 * pow(max(c, 1e-6), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

void main() {
    vec3 normal = length(n) > 0.0 ? normalize(n) : vec3(0.0, 0.0, 1.0), to_eye = normalize(eye - p);
    // A cell above the skin, where the head itself is not.
    vec4 open = texture(seen, (p + 0.006 * normal - low) * cells);
    vec3 light = sky * open.w * SKIN;
    for (int k = 0; k < 3; k++) {
        float facing = max((dot(normal, lamps[k]) + 0.2) / 1.2, 0.0);
        float gloss = 0.12 * pow(max(dot(normal, normalize(lamps[k] + to_eye)), 0.0), 24.0);
        light += open[k] * lamp_light[k] / 3.14159265 * (facing * SKIN + min(facing, 1.0) * gloss);
    }
    colour = vec4(shown(light), 1.0);
}
