//! A scene to start from.

use frisure_hairstyle::Preset;

use crate::natural_look::NaturalLook;

/// A commented scene that sets the hair type and a built-in head, with the type's own numbers beside the
/// keys that would change them.
#[must_use]
pub fn template(preset: &Preset) -> String {
    written(preset, "", "")
}

/// The same as people wear hair of the type: cut, and out of the face ([`NaturalLook`]).
#[must_use]
pub fn worn_template(preset: &Preset) -> String {
    let NaturalLook { cut, pinned, .. } = NaturalLook::of(preset);
    written(preset, if pinned { HOLD } else { "" }, if cut { CUT } else { "" })
}

/// How combed hair is held.
const HOLD: &str = "hold = 2.0                        # pinned out of the face while it dried\n";

/// The haircut.
const CUT: &str = r#"[[step]]                          # to a soft line: hair of one length ends in a point
cut = { below = "shoulders", resting = true, point_cut = "15 mm" }

"#;

/// A scene with these lines about how combed hair is held, and this haircut.
fn written(preset: &Preset, hold: &str, cut: &str) -> String {
    let spec = preset.spec();
    let (section, wisps) = (spec.fibre.section, spec.wisps);
    let (radius, pitch) = spec.curl.radius_pitch().unwrap_or((0.0, 0.0));
    format!(
        r##"# A scene for frisure. Every key has a default; take away a `#` to change one.
# Quantities are texts with a unit ("25 cm", "70 um", "2.5 GPa", "80 deg") or bare SI numbers.

name = "My hairstyle"
seed = 1                          # another seed, another head of the same hair

[head]
{head}

[hair]
type = "{name}"  # {description}
# length = "{length:.0} cm"

[hair.fibre]
# diameter = "{diameter:.0} um"             # mean diameter
# axis_ratio = {ratio:.2}               # longer over shorter axis of the section
# variation = {variation:.2}               # of the diameter, between hairs
# youngs_modulus = "3.9 GPa"
# shear_modulus = "0.9 GPa"       # or poisson_ratio
# density = "1.3 g/cm^3"

[hair.curl]
# radius = "{radius:.1} mm"            # of the natural helix: the curl without weight
# pitch = "{pitch:.1} mm"             # advance per turn
# variation_between = {between:.2}        # from wisp to wisp
# variation_along = {along:.2}          # along a hair

[implantation]
# flow = "parted"                 # or "whorl", "swept-back"
# parting = "2 cm"                # to the head's left; or "middle", "right", "zigzag"
# baby_hairs = 0.25               # of the hairs along the hairline
{hold}# lift_scale = {lift:.1}                # angle to the skin, against the measured

[wisps]
# count = {count}                     # each has one computed guide
# density = "{density:.0} 1/cm^2"        # hairs drawn per area of scalp; or `hairs`
# clumping = {clumping:.2}               # 0 none .. 1 to a point
# fuzziness = {fuzziness:.2}

[look]
{look}

[camera]
# azimuth = "30 deg"              # 0 faces the face

[output]
# width = 900
# height = 1100

{cut}# [[step]]                        # done to the hair, in this order; `frisure style` adds more
# cut = {{ below = "chin", where = "sides" }}
"##,
        name = preset.name,
        description = preset.description,
        length = spec.length.mean * 1e2,
        diameter = section.mean_radius() * 2e6,
        ratio = section.axis_ratio(),
        variation = spec.fibre.variation,
        radius = radius * 1e3,
        pitch = pitch * 1e3,
        between = spec.curl.variation_between,
        along = spec.curl.variation_along,
        lift = preset.hair_type().lift_scale,
        count = wisps.count,
        density = preset.hair_type().density * 1e-4,
        clumping = wisps.clumping,
        fuzziness = wisps.fuzziness,
        head = head_line(preset),
        look = look_lines(preset),
    )
}

/// The built-in head.
fn head_line(preset: &Preset) -> String {
    let model = format!("model = \"{}\"", NaturalLook::of(preset).model);
    format!("{model:<34}# or \"mannequin\", ...: `frisure presets`; or mesh = \"head.obj\"")
}

/// The keys of colours, commented out, with those of the type.
fn look_lines(preset: &Preset) -> String {
    let NaturalLook { colour, skin, .. } = NaturalLook::of(preset);
    let colour = format!("# colour = \"{}\"", colour.name);
    let skin = format!("# skin = \"{}\"", hexadecimal(skin));
    format!(
        "{colour:<34}# or \"blond\", \"black\", \"red\", \"grey\" ...; or pigments, or a dye\n{skin}"
    )
}

/// An sRGB colour as scenes write it.
fn hexadecimal(srgb: [f64; 3]) -> String {
    let [red, green, blue] = srgb.map(|c| (c * 255.0).round() as u8);
    format!("#{red:02x}{green:02x}{blue:02x}")
}
