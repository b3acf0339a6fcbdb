// The head. Needs `common`, `layers` and `shadows`.

struct Vertex {
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) room: vec3<f32>,
}

struct Skin {
    @builtin(position) at: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) room: vec3<f32>,
}

fn projected(p: vec3<f32>) -> vec4<f32> {
    let d = p - picture.eye.xyz;
    let depth = dot(d, picture.forward.xyz);
    let half = 0.5 * vec2<f32>(picture.right.w, picture.up.w);
    let across = vec2<f32>(dot(d, picture.right.xyz), dot(d, picture.up.xyz));
    return vec4<f32>(across * picture.eye.w / half, FAR / (FAR - NEAR) * (depth - NEAR), depth);
}

@vertex
fn skin_vertex(in: Vertex) -> Skin {
    return Skin(projected(in.position), in.position, in.normal, in.room);
}

// The room's light and the lamps', as the preview has it.
@fragment
fn skin(in: Skin) -> @location(0) vec4<f32> {
    let eye = normalize(picture.eye.xyz - in.place);
    var normal = normalize(in.normal);
    normal = select(normal, -normal, dot(normal, eye) < 0.0);
    let colour = picture.skin.rgb;
    let wrap = picture.skin_shape.x;
    let bias = picture.skin_shape.y;
    let radius = picture.skin_shape.z;
    var light = in.room * colour;
    for (var i = 0; i < i32(picture.film.z); i += 1) {
        let lamp = picture.lamps[i];
        let facing = (dot(normal, lamp.towards.xyz) + wrap) / (1.0 + wrap);
        if facing <= 0.0 {
            continue;
        }
        let lifted = in.place + bias * normal;
        var open = past_head(lamp, lifted, bias);
        for (var k = 0; k < 12; k += 1) {
            let angle = TAU * (f32(k) + 0.5) / 4.0 * select(0.5, 1.0, k < 4);
            let r = radius * select(0.85, 0.44, k < 4);
            let aside = r * (cos(angle) * lamp.right.xyz + sin(angle) * lamp.down.xyz);
            open += past_head(lamp, lifted + aside, bias);
        }
        let met = hairs_met(lamp, lifted, picture.hair.z, picture.hair.w);
        let passed = open / 13.0 * exp(-met.before * picture.taken.rgb);
        let half = normalize(lamp.towards.xyz + eye);
        let gloss = picture.skin.a * pow(max(dot(normal, half), 0.0), picture.skin_shape.w);
        light += passed * lamp.light.rgb / PI * (facing * colour + min(facing, 1.0) * gloss);
    }
    return vec4<f32>(behind_planes(light, in.place), 1.0);
}
