//! The heads of scenes, each loaded once.

use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use frisure::files::{Files, Stamp};
use frisure::formats::head::{self, HeadMesh};
use frisure::hairstyle::head::{Head, HeadError, MeshFaults, ScalpSource, Stance};
use frisure::scene::{HeadSource, Scene, SceneError};
use glam::{DMat3, DQuat, DVec3, EulerRot};

use crate::error::message;
use crate::inputs::{head_files, head_mesh, head_note};

/// Most heads in the cache, some megabytes each; chosen.
const CAPACITY: usize = 8;

/// The built-in head, which takes a second to make.
static MANNEQUIN: LazyLock<Arc<Head>> = LazyLock::new(|| Arc::new(Head::mannequin()));

/// The head of a scene.
#[derive(Clone, Debug)]
pub struct LoadedHead {
    /// The head.
    pub head: Arc<Head>,
    /// What was guessed of it, for a person.
    pub note: Option<String>,
}

/// Heads by their description in scenes; shared by threads.
#[derive(Debug, Default)]
pub struct HeadCache {
    /// The last used at the end.
    entries: Mutex<Vec<Entry>>,
}

#[derive(Debug)]
struct Entry {
    source: HeadSource,
    /// Of its files: a mesh may be edited meanwhile.
    stamps: Vec<Option<Stamp>>,
    head: LoadedHead,
}

impl HeadCache {
    /// The head of a scene: the same one as long as the scene and its files are the same.
    ///
    /// # Errors
    /// [`SceneError`] at the key of the scene that has to change.
    pub fn load(&self, scene: &Scene, files: &Files) -> Result<LoadedHead, SceneError> {
        if scene.head == HeadSource::Mannequin {
            return Ok(LoadedHead { head: MANNEQUIN.clone(), note: None });
        }
        let stamps = stamps(&scene.head, files);
        if let Some(head) = self.find(&scene.head, &stamps) {
            return Ok(head);
        }
        // Loaded without the lock: loading runs on all threads, which may come here meanwhile.
        let head = load(scene, files)?;
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        if entries.len() >= CAPACITY {
            entries.remove(0);
        }
        entries.push(Entry { source: scene.head.clone(), stamps, head: head.clone() });
        Ok(head)
    }

    fn find(&self, source: &HeadSource, stamps: &[Option<Stamp>]) -> Option<LoadedHead> {
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        let index = entries.iter().position(|e| e.source == *source && e.stamps == stamps)?;
        let used = entries.remove(index);
        let head = used.head.clone();
        entries.push(used);
        Some(head)
    }
}

fn load(scene: &Scene, files: &Files) -> Result<LoadedHead, SceneError> {
    let HeadSource::Mesh(file) = &scene.head else {
        let head = built_in(scene, &scene.head, "head.model")?;
        return Ok(LoadedHead { head, note: None });
    };
    let mesh = head_mesh(scene, file, files)?;
    let note = head_note(file, &mesh);
    let head = of_mesh(mesh).map_err(|e| {
        let hint = match e {
            HeadError::FloatingScalp { .. } => {
                "move the faces of the scalp onto the head, or name others"
            }
            _ => "",
        };
        scene.error_at("head.mesh", e.to_string(), hint)
    })?;
    let lies = match head.stance() {
        Stance::Lies(upright) if file.turn.is_none() => return Err(lies(scene, upright)),
        // Who turns a head has looked at it, so it is taken; but it is said.
        Stance::Lies(_) => Some(LIES.to_owned()),
        Stance::Leans(upright) if file.turn.is_none() => Some(leans(&upright)),
        Stance::Leans(_) | Stance::Upright => None,
    };
    let notes = [note, lies, holes(&head)].into_iter().flatten();
    let notes: Vec<String> = notes.chain(faults(&head.mesh_faults())).collect();
    let note = (!notes.is_empty()).then(|| notes.join("\n"));
    Ok(LoadedHead { head: Arc::new(head), note })
}

/// The warning about a head that was turned and does not stand upright.
const LIES: &str = "warning: turned by `head.turn`, the head does not stand upright with its face to the front. Its scalp is sought where it lies; \
                    partings and directions of growth may be askew";

/// The warning about a head that leans, with the turn that stands it up.
fn leans(upright: &DMat3) -> String {
    let [x, y, z] = turn_of(*upright);
    let (_, angle) = DQuat::from_mat3(upright).to_axis_angle();
    let angle = angle.to_degrees();
    format!(
        "warning: the head leans by about {angle:.0} degrees from how an average one is held. Its scalp is sought where it leans to, and its hair \
         falls as it leans. `turn = [{x}, {y}, {z}]` in `[head]` stands it up; `turn = [0, 0, 0]` takes it as it is without this warning"
    )
}

/// A rotation as `head.turn` has it (degrees).
fn turn_of(rotation: DMat3) -> [f64; 3] {
    let (z, y, x) = rotation.to_euler(EulerRot::ZYX);
    // No negative zero.
    [x, y, z].map(|angle| angle.to_degrees().round() + 0.0)
}

/// The warning about a head with holes where hair grows.
fn holes(head: &Head) -> Option<String> {
    let holes = head.scalp_holes()?;
    let [x, y, z] = (100.0 * holes.place).to_array();
    let many = match holes.count {
        1 => "a hole".to_owned(),
        count => format!("{count} holes, the largest"),
    };
    Some(format!(
        "warning: where hair grows the head has {many} {:.0} cm around, at ({x:.1}, {y:.1}, {z:.1}) cm: no hair grows there, and hair falls \
         into it. Close it in the mesh, or leave its edge out of the scalp",
        100.0 * holes.around
    ))
}

/// What a person is told of the faults of a mesh.
fn faults(faults: &MeshFaults) -> Vec<String> {
    let MeshFaults { turned, mixed, doubled, apart, scalp } = *faults;
    let mut notes = Vec::new();
    if turned {
        notes.push("the faces of the head look inwards in its file: they were turned".to_owned());
    }
    if let Some(share) = mixed {
        notes.push(format!(
            "warning: at {:.0} % of the edges of the head one face looks outwards and its neighbour inwards; hair may grow inwards there. Let the \
             program that made the mesh turn all of them outwards (Blender: Mesh > Normals > Recalculate Outside)",
            (100.0 * share).ceil()
        ));
    }
    if let Some(count) = doubled {
        notes.push(format!(
            "warning: {count} faces of the head lie on others that have the same corners, and hair grows on each of them: take one of the two away"
        ));
    }
    if let Some((count, middle)) = apart {
        let [x, y, z] = (100.0 * middle).to_array();
        notes.push(format!(
            "warning: the mesh of the head has {count} parts that lie apart from each other, the smallest about ({x:.1}, {y:.1}, {z:.1}) cm. All of \
             them are taken for one head, and its scalp may be sought in the wrong place: leave the head alone in the file"
        ));
    }
    if let Some(times) = scalp.filter(|_| doubled.is_none()) {
        notes.push(format!(
            "warning: the scalp that was guessed is {times:.1} times as large as that of a head of this width. Leave only the head in the file, or say \
             where hair grows: `scalp_group`, `scalp_mask` or `scalp_weights` in `[head]`"
        ));
    }
    notes
}

/// The head that the groom of a scene was made on.
///
/// # Errors
/// [`SceneError`] at the key that names what cannot be used.
pub(crate) fn groom_head(
    scene: &Scene,
    source: &HeadSource,
    files: &Files,
) -> Result<Arc<Head>, SceneError> {
    const KEY: &str = "groom.head_mesh";
    let HeadSource::Mesh(file) = source else { return built_in(scene, source, "groom.head_model") };
    let mesh = head::read(file, files).map_err(|e| scene.error_at(KEY, message(&e), ""))?;
    let head = of_mesh(mesh).map_err(|e| scene.error_at(KEY, e.to_string(), ""))?;
    if let Stance::Lies(_) = head.stance() {
        let problem = "the head of the groom does not stand upright with its face to the front";
        let hint = "export groom and mesh with the head upright";
        return Err(scene.error_at(KEY, problem, hint));
    }
    Ok(Arc::new(head))
}

fn built_in(scene: &Scene, source: &HeadSource, key: &str) -> Result<Arc<Head>, SceneError> {
    let HeadSource::Person { name, face } = source else { return Ok(MANNEQUIN.clone()) };
    let head = Head::with_face(name, *face).map(Arc::new);
    head.ok_or_else(|| scene.error_at(key, "there is no head of this name", ""))
}

fn of_mesh(mesh: HeadMesh) -> Result<Head, HeadError> {
    let scalp = mesh.scalp.map_or(ScalpSource::Guess, ScalpSource::Weights);
    Head::from_surface(mesh.surface, scalp)
}

/// The error about a head that does not stand upright, with the rotation that it needs.
fn lies(scene: &Scene, upright: DMat3) -> SceneError {
    let [x, y, z] = turn_of(upright);
    let DVec3 { x: left, y: back, z: up } = upright * DVec3::NEG_Z;
    let problem = "the head does not stand upright with its face to the front: hair would grow where no scalp is";
    let hint = format!(
        "write `turn = [{x}, {y}, {z}]` in `[head]`, which stands it up. If it is meant to be held as it is in the file, write also \
         `down = [{left:.2}, {back:.2}, {up:.2}]` in `[pose]`, the direction of gravity. \
         `turn = [0, 0, 0]` takes the file as it is"
    );
    scene.error_at("head.mesh", problem, &hint)
}

fn stamps(source: &HeadSource, files: &Files) -> Vec<Option<Stamp>> {
    head_files(source).map(|path| files.stamp(path)).collect()
}
