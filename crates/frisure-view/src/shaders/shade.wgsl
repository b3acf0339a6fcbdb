// Light that hair sends to the eye, once per vertex: each texel of the target is a vertex.
// Needs `common`, `layers` and `shadows`.

@group(2) @binding(0) var places: texture_2d<f32>;
@group(2) @binding(1) var traits: texture_2d<u32>;
@group(2) @binding(2) var diffuses: texture_2d<f32>;
@group(2) @binding(3) var transmissions: texture_2d<f32>;
@group(2) @binding(4) var returns: texture_2d<f32>;
@group(2) @binding(5) var marks: texture_2d<f32>;
@group(3) @binding(0) var ambient_volume: texture_3d<f32>;

struct Rows {
    @builtin(position) at: vec4<f32>,
    // How many lamps and planes there are.
    @location(0) @interpolate(flat) counts: vec2<i32>,
}

@vertex
fn every_vertex(@builtin(vertex_index) corner: u32) -> Rows {
    return Rows(everything(corner), vec2<i32>(i32(picture.film.z), i32(picture.film.w)));
}

// The unit vector that an octahedron was unfolded from.
fn unfolded(bits: u32) -> vec3<f32> {
    let e = unpack2x16snorm(bits);
    var v = vec3<f32>(e, 1.0 - abs(e.x) - abs(e.y));
    let t = max(-v.z, 0.0);
    v.x += select(t, -t, v.x >= 0.0);
    v.y += select(t, -t, v.y >= 0.0);
    return normalize(v);
}

// Normal density of standard deviation `width`.
fn gaussian(x: f32, width: f32) -> f32 {
    let u = x / width;
    return exp(-0.5 * u * u) / (width * sqrt(TAU));
}

fn room_light(p: vec3<f32>) -> vec3<f32> {
    let size = picture.room_size.xyz;
    let g = clamp((p - picture.room_low.xyz) * picture.room_low.w, vec3<f32>(0.0), size - 1.0);
    return textureSampleLevel(ambient_volume, smooth_sampler, (g + 0.5) / size, 0.0).rgb;
}

// What is known of a vertex before any lamp is looked at.
struct Point {
    p: vec3<f32>,
    tangent: vec3<f32>,
    eye: vec3<f32>,
    diffuse: vec3<f32>,
    reflected: vec3<f32>,
    transmitted: vec3<f32>,
    returned: vec3<f32>,
    // Deviation along the fibre, tilt, deviation around it, shift of the highlights (rad).
    lobes: vec4<f32>,
}

// The light of a lamp that a point sends to the eye.
fn from_lamp(at: Point, lamp: Lamp) -> vec3<f32> {
    // Hairs on the way take a part of the light each: `passed` by colour, `straight` of light that meets none.
    let met = hairs_met(lamp, at.p, picture.hair.z, picture.hair.w);
    let head = past_head(lamp, at.p, picture.room_size.w);
    let passed = exp(-met.before * picture.extinction.rgb);
    let straight = exp(-met.before);

    // The lobes of `frisure_optics::lobes`: inclinations from the plane across the fibre, and the azimuth between light and
    // eye. Highlights are shifted by -2, 1 and 4 times the tilt, and along the strand by its own deviation.
    let sl = clamp(dot(at.tangent, lamp.towards.xyz), -1.0, 1.0);
    let se = clamp(dot(at.tangent, at.eye), -1.0, 1.0);
    let across = sqrt(max((1.0 - sl * sl) * (1.0 - se * se), 1e-12));
    let cos_phi = clamp((dot(lamp.towards.xyz, at.eye) - sl * se) / across, -1.0, 1.0);
    let sum = asin(sl) + asin(se) + at.lobes.w;
    let caught = sqrt(max(1.0 - sl * sl, 0.0));
    let phi = acos(cos_phi);
    let width = at.lobes.x;
    let tilt = at.lobes.y;
    let r = caught * gaussian(sum + 2.0 * tilt, width) * 0.25 * cos(0.5 * phi);
    let tt = caught * gaussian(sum - tilt, 0.5 * width) * gaussian(PI - phi, at.lobes.z);
    let trt = caught * gaussian(sum - 4.0 * tilt, 2.0 * width) * (1.0 + cos_phi) / TAU;

    // [Kajiya & Kay 1989]: sin(t, l)/pi.
    let scattered = caught / PI * at.diffuse;
    let direct = r * at.reflected + trt * at.returned;
    let through = tt * at.transmitted;
    // Within its cell hair that is seen stands partly in the shadow of other hair that is.
    let open = 1.0 - picture.lobes.w * (1.0 - exp(-met.around));
    return head * lamp.light.rgb
        * (passed * scattered + open * (0.5 * (passed + straight) * direct + straight * through));
}

@fragment
fn shade(in: Rows) -> @location(0) vec4<f32> {
    let where_ = vec2<i32>(in.at.xy);
    let index = u32(where_.y) * ROW + u32(where_.x);
    if index >= u32(picture.extinction.w) {
        return vec4<f32>(0.0);
    }
    let own = textureLoad(traits, where_, 0);
    let wet_and_part = unpack2x16unorm(own.y);
    let wet = wet_and_part.x;
    let strand = own.z;
    let matter = texel(select(strand, index, picture.hair.x > 0.5));
    let diffuse_strength = textureLoad(diffuses, matter, 0);
    let transmitted_shift = textureLoad(transmissions, matter, 0);

    var point: Point;
    point.p = textureLoad(places, where_, 0).xyz;
    point.tangent = unfolded(own.x);
    point.eye = normalize(picture.eye.xyz - point.p);
    point.diffuse = diffuse_strength.rgb * (1.0 - picture.wet.x * wet);
    point.transmitted = transmitted_shift.rgb;
    point.returned = textureLoad(returns, matter, 0).rgb * (1.0 - picture.wet.y * wet);
    point.reflected = diffuse_strength.a * (1.0 - picture.wet.z * wet) * picture.reflected.rgb;
    point.lobes = vec4<f32>(
        picture.lobes.x * (1.0 - picture.wet.w * wet),
        picture.lobes.y * (1.0 - wet),
        picture.lobes.z,
        transmitted_shift.a,
    );

    let mirrored = point.diffuse + picture.reflected.w * point.reflected + point.returned;
    var light = room_light(point.p) * mirrored;
    for (var i = 0; i < in.counts.x; i += 1) {
        light += from_lamp(point, picture.lamps[i]);
    }

    let mark = textureLoad(marks, texel(strand), 0);
    let bright = max(max(light.r, light.g), light.b);
    light = mix(light, picture.chosen.rgb * (0.25 + bright), picture.chosen.a * mark.x);
    light = behind_planes(light, point.p, in.counts.y);
    return vec4<f32>(light, wet_and_part.y - mark.y);
}
