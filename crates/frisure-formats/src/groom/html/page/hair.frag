#version 300 es
precision highp float;

in vec3 light;
flat in float cover;
flat in float seed;
out vec4 colour;

// Linear up to 0.55 and then towards white, as frisure's pictures have it; sRGB.
vec3 shown(vec3 c) {
    vec3 over = max(c - 0.55, 0.0);
    c = min(c, 0.55) + 0.45 * over / (over + 0.45);
    return mix(12.92 * c, 1.055 * pow(max(c, 1e-6), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

void main() {
    float chance = fract(seed + dot(gl_FragCoord.xy, vec2(0.7548777, 0.5698403)));
    if (chance >= cover) discard;
    colour = vec4(shown(light), 1.0);
}
