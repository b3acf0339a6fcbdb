//! Parting.

use frisure_rod::{InvalidQuantity, Rod, RodSpec, Root};
use glam::DMat3;

use crate::hairstyle::Hairstyle;
use crate::spec::InvalidSpec;
use crate::styling::error::StyleError;
use crate::styling::settle::Act;
use super::apply::Apply;
use crate::guides::{Guide, Planned, covered, plan};
use crate::head::Head;
use crate::implantation::{Layout, Ways};
use crate::spec::{Flow, Parting};

/// Parts all hair anew: roots turn away from the line to both sides, and hair falls to the side that
/// it is turned to. The hair beside it keeps it there, as with [`crate::Flow::Parted`].
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The line.
    pub line: Parting,
}

impl Default for Part {
    fn default() -> Self {
        Self { line: Parting::Straight { offset: 0.0 } }
    }
}

impl Apply for Part {
    fn check(&self) -> Result<(), InvalidSpec> {
        self.line.check().map_err(|error| {
            let field =
                if matches!(self.line, Parting::Through(_)) { "part.line" } else { "part.at" };
            InvalidSpec { field, ..error }
        })
    }

    fn mirror(&mut self) {
        match &mut self.line {
            Parting::Straight { offset } | Parting::Zigzag { offset } => *offset = -*offset + 0.0,
            Parting::Through(points) => points.iter_mut().for_each(|[x, _]| *x = -*x + 0.0),
        }
    }

    /// Roots turn as if the hair had been planted with this parting; fibres stay what they are.
    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        let Act { before: hair, head, .. } = *act;
        let mut spec = hair.spec.clone();
        let offset = match self.line {
            Parting::Straight { offset } | Parting::Zigzag { offset } => offset,
            Parting::Through(_) => 0.0,
        };
        spec.implantation.flow = Flow::Parted { offset };
        spec.implantation.partings = vec![self.line.clone()];
        let layout = Layout::new(&spec, head)?;
        let placement = &hair.placement;
        let mut planned = plan(&spec, head, &layout, placement.roots(), placement.area())?;
        let ways = Ways::new(&spec, head, &layout);
        for (planned, old) in planned.iter_mut().zip(&*hair.styling.planned) {
            if old.bed.is_some() {
                *planned = replanted(old, planned, &ways, hair, head)?;
            }
        }
        let everyone = vec![true; planned.len()];
        let mut styling = hair.styling.changed(&everyone, |_, wisp| wisp.moved += 1);
        styling.planned = planned.into();
        let replanted = Hairstyle { spec, layout, ..hair.clone() };
        let mut parted = act.on(&replanted).with(styling)?;
        let ends = parted.styling.ends.take();
        parted.styling.ends = ends.map(|ends| ends.replanted(&parted, head));
        Ok(parted)
    }
}

/// A guide of a groom, whose fibre no description has, turned about the normal of the skin until it leaves to the side to which `planned` does.
fn replanted(
    old: &Guide,
    planned: &Guide,
    ways: &Ways<'_>,
    hair: &Hairstyle,
    head: &Head,
) -> Result<Guide, InvalidQuantity> {
    let normal = old.root.normal;
    let flat = |guide: &Guide| {
        let tangent = guide.rod.root().frame().z_axis;
        tangent - normal * normal.dot(tangent)
    };
    let (from, to) = (flat(old), flat(planned));
    let angle = normal.dot(from.cross(to)).atan2(from.dot(to));
    let root = old.rod.root();
    let frame = DMat3::from_axis_angle(normal, angle) * root.frame();
    let root = Root::new(root.position(), frame.x_axis, frame.y_axis, frame.z_axis)?;
    let rod = Rod::new(RodSpec { root, ..old.rod.spec().clone() })?;
    let fibre = Planned { rod, curl: old.curl, share: old.share };
    let covered = covered(&hair.spec, head, hair.placement.area(), ways, old.root, fibre);
    Ok(Guide { bed: old.bed.clone(), hold: planned.hold, ..covered })
}
