#version 300 es
precision highp float;

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 direction;

uniform vec3 eye, right, above, forward;
uniform vec2 size, shift;
uniform vec3 lens;

out vec3 p;
out vec3 n;

void main() {
    vec3 d = place - eye;
    float depth = dot(d, forward);
    vec2 on_picture = vec2(dot(d, right), dot(d, above)) * lens.x + shift * depth;
    float z = lens.z / (lens.z - lens.y) * (depth - lens.y);
    p = place;
    n = direction;
    gl_Position = vec4(2.0 * on_picture / size, 2.0 * z - depth, depth);
}
