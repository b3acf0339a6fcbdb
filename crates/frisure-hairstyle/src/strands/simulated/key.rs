//! The key of a checkpoint: a digest of all that simulated hairs depend on.

use frisure_digest::{Digest, Digestible, digest_fields};
use frisure_rod::{Load, NaturalStrain, RodSpec, Root as Clamp};

use crate::fibre::{Handedness, WetLocks};
use crate::guides::Guide;
use crate::hairstyle::Hairstyle;
use crate::head::{Head, Region};
use crate::implantation::Root;
use crate::rod_digest::{add_material, add_section, add_torsion};
use crate::spec::{
    Body, Comb, Flow, HairContact, HairModel, Hairs, HeadMethod, Level, Lift, Parting, Place,
    RegionLength, StrandContact, Turn,
};

/// What the hairs of this hairstyle depend on, for the same version: if it is the same, so are the hairs.
pub(crate) fn key(hairstyle: &Hairstyle, head: &Head, roots: &[(usize, Root)]) -> u64 {
    let mut digest = Digest::new("simulated hairs");
    digest.field("version", env!("CARGO_PKG_VERSION"));
    digest.field("spec", &hairstyle.spec).field("guides", &hairstyle.guides);
    for rest in &hairstyle.rest.guides {
        digest.field("positions", &rest.shape.positions);
        digest.sequence("d1", rest.shape.frames.iter().map(|frame| frame.x_axis));
    }
    digest.field("head", head.surface().positions()).field("roots", roots);
    digest.key()
}

digest_fields!(Handedness: Random, AsGiven);
digest_fields!(WetLocks: Factor, Capillary);
digest_fields!(Turn: Clockwise, Anticlockwise);
digest_fields!(Parting: Straight { offset }, Zigzag { offset }, Through(points));
digest_fields!(Place: Region(region), LeftOf(region), RightOf(region), Left, Right, Everywhere);
digest_fields!(Region: Fringe, Top, Crown, Sides, Back, Nape);
digest_fields!(RegionLength: Mean(length), DownTo(level));
digest_fields!(Level: Brows, Eyes, Ears, Chin, Nape, Shoulders, Chest);
digest_fields!(Comb: Forward, Back, Down, Left, Right);
digest_fields!(Flow: Whorl, Parted { offset }, SweptBack);
digest_fields!(Lift: Regional { scale }, Uniform(lift));
digest_fields!(HairModel: Interpolated, Simulated);
digest_fields!(StrandContact: Tube, Contacts, Density);
digest_fields!(Hairs: Count(n), PerWisp(n), Density(density));
digest_fields!(Body: None, Spheres, SignedDistance);
digest_fields!(HairContact: None, Layers, Wisps, Density);
digest_fields!(HeadMethod: Sweeps, Continuation);
digest_fields!(Root { position, normal });

impl Digestible for Guide {
    fn add_to(&self, digest: &mut Digest) {
        let Self {
            root,
            region,
            rod,
            thickness,
            layer,
            bed,
            pull,
            firmness,
            hold,
            friction,
            curl,
            share,
        } = self;
        digest.field("root", root).field("region", region);
        add_rod(digest, rod.spec());
        digest.field("thickness", thickness).field("layer", layer).field("bed", bed);
        digest.field("pull", pull).field("firmness", firmness).field("hold", hold);
        digest.field("friction", friction).field("curl", curl).field("share", share);
    }
}

fn add_rod(digest: &mut Digest, rod: &RodSpec) {
    let RodSpec { length, section, material, torsion, natural, root, load } = rod;
    digest.field("length", length);
    add_section(digest, section);
    add_material(digest, material);
    add_torsion(digest, torsion);
    match natural {
        NaturalStrain::Uniform(strain) => digest.field("strain", strain),
        NaturalStrain::Varying(profile) => digest.field("strains", profile.knots()),
    };
    add_clamp(digest, root);
    let Load { gravity, force } = load;
    digest.field("gravity", gravity).field("force", force);
}

fn add_clamp(digest: &mut Digest, root: &Clamp) {
    let frame = root.frame();
    digest.field("position", &root.position());
    digest.field("frame", &[frame.x_axis, frame.y_axis, frame.z_axis]);
}
