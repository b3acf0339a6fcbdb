//! A hairstyle as a groom for other programs.

use frisure::formats::groom::{Groom, HairColour};
use frisure::hairstyle::head::Head;
use frisure::hairstyle::{self, Hairstyle};
use frisure::look::apparent_colour;
use frisure::scene::Scene;
use frisure::strands::Strands;

/// The groom of a hairstyle: `hairs`, which are all its drawn hairs, its guides, its head and its colour.
/// With `fibres`, each hair has the directors and natural strains of its fibre too, as guides always have.
pub(crate) fn groom(
    scene: &Scene,
    hairstyle: &Hairstyle,
    head: &Head,
    mut hairs: Strands,
    fibres: bool,
) -> Groom {
    if !hairs.is_empty() {
        hairstyle::describe(&mut hairs, hairstyle, head);
    }
    if fibres {
        if hairs.attribute("d1").is_none() {
            hairstyle::add_sections(&mut hairs, hairstyle, head);
        }
        hairstyle::add_natural_strains(&mut hairs, hairstyle);
    }
    let guides = hairstyle::described_guides(hairstyle, head, hairstyle.spec().wisps.points);
    let head = Some(head.surface().clone());
    let (name, colour) = (name(scene), Some(colour(scene)));
    Groom { name, hairs, guides, head, colour }
}

/// The scene's name as far as a program can have it for a name: letters, digits, underscores.
fn name(scene: &Scene) -> String {
    let fit = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    scene.name.chars().map(fit).collect()
}

/// What much of the hair looks like between its ends.
fn colour(scene: &Scene) -> HairColour {
    let hair = scene.look.hair;
    let natural = hair.natural();
    let absorption = hair.dye.map_or(natural, |dye| natural.lerp(dye.absorption, dye.strength));
    let seen = apparent_colour(absorption, hair.surface.azimuthal_roughness);
    let plain = hair.dye.is_none() && hair.absorption.is_none();
    HairColour { melanin: plain.then_some(hair.melanin), colour: seen.to_array() }
}
