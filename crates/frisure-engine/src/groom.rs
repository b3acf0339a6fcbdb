//! The groom of a scene, for other programs.

use frisure::formats::groom::{Groom, HairColour};
use frisure::hairstyle;
use frisure::look::apparent_colour;
use frisure::render::strand_colours;
use frisure::scene::Scene;
use frisure::strands::{Strands, names};

use glam::Vec3;

use crate::runner::LoadedScene;

impl LoadedScene {
    /// A groom of `hairs`, which are all drawn hairs, with guides, head and colour. With `fibres`, each hair has the
    /// directors and natural strains of its fibre too, as guides always have.
    #[must_use]
    pub fn groom(&self, mut hairs: Strands, fibres: bool) -> Groom {
        let Self { scene, head, hairstyle, .. } = self;
        if !hairs.is_empty() {
            hairstyle::describe(&mut hairs, hairstyle, head);
            // A groom of another program keeps its own.
            if hairs.attribute(names::COLOUR).is_none()
                && let Some(colours) = strand_colours(&hairs, &scene.look.hair)
            {
                hairs.set_attribute(colours).expect("as many values as strands or points");
            }
        }
        if fibres {
            if hairs.attribute("d1").is_none() {
                hairstyle::add_sections(&mut hairs, hairstyle, head);
            }
            hairstyle::add_natural_strains(&mut hairs, hairstyle);
        }
        let guides = hairstyle::described_guides(hairstyle, head, hairstyle.spec().wisps.points);
        let head = Some(hairstyle::head::textured(head));
        Groom {
            name: name(scene),
            hairs,
            guides,
            head,
            colour: Some(colour(scene)),
            ..Groom::default()
        }
    }
}

/// The scene's name in letters, digits and underscores.
fn name(scene: &Scene) -> String {
    let fit = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    scene.name.chars().map(fit).collect()
}

/// The colour of the hair between its ends, on average over white and other hairs.
fn colour(scene: &Scene) -> HairColour {
    let hair = scene.look.hair;
    let natural = hair.natural();
    let absorption = hair.dye.map_or(natural, |dye| natural.lerp(dye.absorption, dye.strength));
    let apparent = apparent_colour(absorption, hair.surface.azimuthal_roughness);
    // White hair has no pigment, and scatters all light.
    let apparent = apparent.lerp(Vec3::ONE, hair.white_share.clamp(0.0, 1.0));
    let plain = hair.dye.is_none() && hair.absorption.is_none() && hair.white_share <= 0.0;
    HairColour { melanin: plain.then_some(hair.melanin), colour: apparent.to_array() }
}
