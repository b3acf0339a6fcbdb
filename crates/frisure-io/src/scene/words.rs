//! The words that keys of a scene can take.

use frisure_hairstyle::{Ellipticity, Handedness, PRESETS, Preset};
use frisure_rod::{ElementKind, TorsionConstant};

use super::key::Choice;

/// A hair type, by its name.
#[derive(Clone, Copy)]
pub(super) struct HairType(pub(super) &'static Preset);

impl Choice for HairType {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        PRESETS.iter().map(|p| (p.name, p.description, Self(p))).collect()
    }
}

/// A value that is itself one of a few: each word stands for it.
#[derive(Clone, Copy)]
pub(super) struct Which<T>(pub(super) T);

/// The axis of a mesh that points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpAxis {
    /// y up, face towards +z, as most OBJ files are.
    #[default]
    Y,
    /// z up, face towards −y, as frisure itself.
    Z,
}

impl Choice for Which<UpAxis> {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("y", "y up, the face looks along +z", Self(UpAxis::Y)),
            ("z", "z up, the face looks along -y", Self(UpAxis::Z)),
        ]
    }
}

/// Metres per unit of a mesh.
#[derive(Clone, Copy)]
pub(super) struct UnitWord(pub(super) f64);

impl Choice for UnitWord {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("m", "metres", Self(1.0)),
            ("dm", "decimetres", Self(0.1)),
            ("cm", "centimetres", Self(0.01)),
            ("mm", "millimetres", Self(0.001)),
            ("in", "inches", Self(0.0254)),
        ]
    }
}

impl Choice for Which<Ellipticity> {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("measured", "the measured axis ratio and its spread", Self(Ellipticity::Measured)),
            ("paper", "the paper's eccentricity, nearly a circle", Self(Ellipticity::Paper)),
        ]
    }
}

/// Which equilibrium of one hair is asked for, where there are several.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum BranchKind {
    /// The one that the natural shape comes to as gravity grows from nothing.
    #[default]
    Gravity,
    /// The one of lowest energy that several starting shapes lead to.
    Lowest,
}

impl Choice for Which<BranchKind> {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            (
                "gravity",
                "followed from the natural shape as gravity grows",
                Self(BranchKind::Gravity),
            ),
            ("lowest", "the lowest energy that several starts lead to", Self(BranchKind::Lowest)),
        ]
    }
}

impl Choice for Which<TorsionConstant> {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("saint-venant", "exact for an ellipse", Self(TorsionConstant::SaintVenant)),
            ("polar", "I1 + I2, as in the paper", Self(TorsionConstant::Polar)),
        ]
    }
}

impl Choice for Which<ElementKind> {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("auto", "the better of the two for the hair", Self(ElementKind::Auto)),
            ("jointed", "two pieces of the natural helix and a joint", Self(ElementKind::Jointed)),
            ("helix", "constant strain, as in the paper", Self(ElementKind::Helix)),
        ]
    }
}

/// Which way curls turn.
#[derive(Clone, Copy)]
pub(super) struct Handed(pub(super) Handedness);

impl Choice for Handed {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("random", "each wisp as given or mirrored", Self(Handedness::Random)),
            ("as-given", "all as the strain says", Self(Handedness::AsGiven)),
        ]
    }
}

/// The direction in which hair leaves the scalp; the parting's place is a key of its own.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum FlowWord {
    Whorl,
    Parted,
    SweptBack,
}

impl Choice for FlowWord {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("whorl", "as it grows, around the crown and over the forehead", Self::Whorl),
            ("parted", "to both sides of a parting", Self::Parted),
            ("swept-back", "back from the forehead", Self::SweptBack),
        ]
    }
}

/// What hair lies on.
#[derive(Clone, Copy)]
pub(super) struct BodyWord(pub(super) frisure_hairstyle::Body);

impl Choice for BodyWord {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        use frisure_hairstyle::Body;
        vec![
            ("none", "hair passes through the head", Self(Body::None)),
            ("spheres", "spheres fitted to the head, as in the paper", Self(Body::Spheres)),
            ("signed-distance", "the mesh itself", Self(Body::SignedDistance)),
        ]
    }
}
