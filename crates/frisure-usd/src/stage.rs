//! The prims of a layer that are defined, active and visible, with their transforms.

use glam::{DMat3, DMat4, DQuat, DVec3};

use super::layer::{Layer, Prim, Specifier};
use super::value::{ScalarType, Shape, Value, ValueType};

/// Unit of a stage that does not say: the centimetre.
const USUAL_METRES: f64 = 0.01;

/// A prim in its place.
#[derive(Clone, Debug)]
pub struct StagePrim<'a> {
    /// The prim itself.
    pub prim: &'a Prim,
    /// The place of the prim that it is in.
    parent: Option<usize>,
    /// From the prim's own space to the stage's.
    pub world: DMat4,
    /// Whether it, or what it is in, is there to guide only.
    pub is_guide: bool,
}

/// All prims that are there, in their order.
#[derive(Debug)]
pub struct Stage<'a> {
    /// Parents stand before their children.
    pub prims: Vec<StagePrim<'a>>,
    /// Metres per unit of its positions.
    pub metres_per_unit: f64,
    /// Whether z points up in it, and not y.
    pub is_z_up: bool,
    /// The composition arcs of its prims, each once.
    arcs: Vec<&'a str>,
}

/// Properties that a prim inherits from the prims above it.
#[derive(Clone, Copy)]
struct Above {
    world: DMat4,
    is_guide: bool,
}

impl<'a> Stage<'a> {
    /// The prims of a layer that are defined, active and visible.
    pub fn of(layer: &'a Layer) -> Result<Self, String> {
        let metres = layer.meta("metersPerUnit").and_then(Value::number);
        let mut stage = Self {
            prims: Vec::new(),
            metres_per_unit: metres.unwrap_or(USUAL_METRES),
            is_z_up: layer.meta("upAxis").and_then(Value::word) == Some("Z"),
            arcs: Vec::new(),
        };
        let above = Above { world: DMat4::IDENTITY, is_guide: false };
        for prim in &layer.prims {
            stage.add(prim, None, above)?;
        }
        Ok(stage)
    }

    fn add(&mut self, prim: &'a Prim, parent: Option<usize>, above: Above) -> Result<(), String> {
        let inactive = prim.meta("active").and_then(Value::number) == Some(0.0);
        let invisible = prim.word("visibility") == Some("invisible");
        // What stands in for something else while it is being worked on.
        let is_proxy = prim.word("purpose") == Some("proxy");
        if prim.specifier != Specifier::Def || inactive || invisible || is_proxy {
            return Ok(());
        }
        for arc in &prim.arcs {
            if !self.arcs.contains(&arc.as_str()) {
                self.arcs.push(arc);
            }
        }
        let (own, resets) = transform(prim).map_err(|e| format!("`{}`: {e}", prim.name))?;
        let world = if resets { own } else { above.world * own };
        let is_guide = above.is_guide || prim.word("purpose") == Some("guide");
        let here = self.prims.len();
        self.prims.push(StagePrim { prim, parent, world, is_guide });
        let above = Above { world, is_guide };
        prim.children.iter().try_for_each(|child| self.add(child, Some(here), above))
    }

    /// The path of a prim, such as `/groom/hairs`; not stored, since it has the names of all prims above.
    pub fn path(&self, place: &StagePrim) -> String {
        let mut names = vec![place.prim.name.as_str()];
        let mut parent = place.parent;
        while let Some(above) = parent.and_then(|i| self.prims.get(i)) {
            names.push(&above.prim.name);
            parent = above.parent;
        }
        names.reverse();
        format!("/{}", names.join("/"))
    }

    /// An error about a prim.
    pub fn fault(&self, place: &StagePrim, problem: &str) -> String {
        format!("<{}>: {problem}", self.path(place))
    }

    /// The prim of a path.
    pub fn prim(&self, path: &str) -> Option<&'a Prim> {
        let mut names = path.strip_prefix('/')?.split('/');
        let first = names.next()?;
        let roots = self.prims.iter().filter(|p| p.parent.is_none()).map(|p| p.prim);
        let mut prim = roots.into_iter().find(|p| p.name == first)?;
        for name in names {
            prim = prim.children.iter().find(|p| p.name == name)?;
        }
        Some(prim)
    }

    /// A hint for an error that nothing was found: composition arcs are not followed.
    pub fn hint(&self) -> String {
        if self.arcs.is_empty() {
            return String::new();
        }
        let arcs = self.arcs.join(", ");
        format!("; it has {arcs}, which are not followed: flatten it first (`usdcat --flatten`)")
    }
}

/// The transform of a prim, and whether it resets those of the prims above.
fn transform(prim: &Prim) -> Result<(DMat4, bool), String> {
    let mut all = DMat4::IDENTITY;
    let mut resets = false;
    let Some(order) = prim.value("xformOpOrder") else { return Ok((all, resets)) };
    for op in order.all_words() {
        if op == "!resetXformStack!" {
            (all, resets) = (DMat4::IDENTITY, true);
            continue;
        }
        let (name, inverse) = match op.strip_prefix("!invert!") {
            Some(name) => (name, true),
            None => (op.as_str(), false),
        };
        let Some(value) = prim.value(name) else { continue };
        let matrix = operation(name, value)?;
        all *= if inverse { matrix.inverse() } else { matrix };
    }
    let finite = all.to_cols_array().iter().all(|x| x.is_finite());
    if finite { Ok((all, resets)) } else { Err("its place is not finite".into()) }
}

/// One operation, such as `xformOp:rotateXYZ:turned`.
fn operation(name: &str, value: &Value) -> Result<DMat4, String> {
    let kind = name.split(':').nth(1).unwrap_or("");
    let numbers = value.numbers().unwrap_or_default();
    let wrong = || format!("`{name}` cannot be {numbers:?}");
    let three = || match numbers[..] {
        [x, y, z] => Ok(DVec3::new(x, y, z)),
        _ => Err(wrong()),
    };
    let one = || match numbers[..] {
        [x] => Ok(x),
        _ => Err(wrong()),
    };
    let turn = |axis: DVec3| Ok(DMat4::from_axis_angle(axis, one()?.to_radians()));
    match kind {
        "translate" => Ok(DMat4::from_translation(three()?)),
        "translateX" => Ok(DMat4::from_translation(DVec3::X * one()?)),
        "translateY" => Ok(DMat4::from_translation(DVec3::Y * one()?)),
        "translateZ" => Ok(DMat4::from_translation(DVec3::Z * one()?)),
        "scale" => Ok(DMat4::from_scale(three()?)),
        "scaleX" => Ok(DMat4::from_scale(DVec3::new(one()?, 1.0, 1.0))),
        "scaleY" => Ok(DMat4::from_scale(DVec3::new(1.0, one()?, 1.0))),
        "scaleZ" => Ok(DMat4::from_scale(DVec3::new(1.0, 1.0, one()?))),
        "rotateX" => turn(DVec3::X),
        "rotateY" => turn(DVec3::Y),
        "rotateZ" => turn(DVec3::Z),
        "orient" => match numbers[..] {
            [w, x, y, z] => {
                let q = DQuat::from_xyzw(x, y, z, w);
                let q = if q.length() > 0.0 { q.normalize() } else { DQuat::IDENTITY };
                Ok(DMat4::from_quat(q))
            }
            _ => Err(wrong()),
        },
        "transform"
            if value.ty == (ValueType { scalar: ScalarType::Double, shape: Shape::Matrix(4) }) =>
        {
            // Rows of files, which multiply from the left, are columns.
            let all = numbers.as_slice().try_into().map_err(|_| wrong())?;
            Ok(DMat4::from_cols_array(all))
        }
        "transform" if numbers.len() == 9 => {
            let all = numbers.as_slice().try_into().map_err(|_| wrong())?;
            Ok(DMat4::from_mat3(DMat3::from_cols_array(all)))
        }
        _ => match kind.strip_prefix("rotate") {
            Some(axes) if axes.len() == 3 => turns(axes, three()?).ok_or_else(wrong),
            _ => Err(format!("`{name}` is not known")),
        },
    }
}

/// Turns about three axes, the first named the first carried out.
fn turns(axes: &str, angles: DVec3) -> Option<DMat4> {
    let mut all = DMat4::IDENTITY;
    for axis in axes.chars() {
        let (axis, angle) = match axis {
            'X' => (DVec3::X, angles.x),
            'Y' => (DVec3::Y, angles.y),
            'Z' => (DVec3::Z, angles.z),
            _ => return None,
        };
        all = DMat4::from_axis_angle(axis, angle.to_radians()) * all;
    }
    Some(all)
}
