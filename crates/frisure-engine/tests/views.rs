//! Views of a batch: the maps of a picture are those of the hairs that a prediction draws.

use std::path::Path;
use std::sync::Arc;

use frisure::hairstyle::StrandOptions;
use frisure::render::maps::Pinhole;
use frisure::scene::Scene;
use frisure::scene::batch::{Batch, Views};
use frisure::strands::{AttributeValues, Strand};
use frisure_engine::picture::Viewed;
use frisure_engine::{LoadedScene, Quality, Runner};
use glam::{DVec2, DVec3};

const BATCH: &str = r#"
    samples = 1
    [views]
    cameras = ["front", "back", { azimuth = "60 deg", elevation = "30 deg" }]
    size = [160, 200]
    hairs = 250
"#;

fn views() -> Views {
    Batch::parse("batch", BATCH, Path::new("")).unwrap().views().unwrap().clone()
}

fn loaded(kind: &str) -> LoadedScene {
    let text = format!(
        "hair = {{ type = '{kind}', length = '12 cm' }}\nwisps = {{ count = 30, hairs = 600 }}"
    );
    let scene = Arc::new(Scene::parse("scene", text, Path::new("")).unwrap());
    Runner::default().load(&scene, 0, Quality::Exact, &()).unwrap()
}

/// Where a strand passes a place of the picture: the distance (pixels), and there its depth (m), its change over a pixel (m), and
/// its direction in the picture.
struct Passing {
    distance: f64,
    depth: f64,
    slope: f64,
    direction: DVec2,
}

fn passings(camera: &Pinhole, strand: &Strand<'_>, place: DVec2) -> Vec<Passing> {
    let seen: Vec<DVec3> = strand.points.iter().map(|p| camera.project(p.as_dvec3())).collect();
    let pieces = seen.windows(2).map(|ends| {
        let along = ends[1] - ends[0];
        let length = along.truncate().length().max(1e-9);
        let direction = along.truncate() / length;
        let part = ((place - ends[0].truncate()).dot(direction) / length).clamp(0.0, 1.0);
        let nearest = ends[0] + part * along;
        let distance = nearest.truncate().distance(place);
        Passing { distance, depth: nearest.z, slope: along.z.abs() / length, direction }
    });
    pieces.collect()
}

/// Each hair of a map is one of all hairs of the head by its index, and is projected to the pixels that name it, within a
/// pixel; its depth and direction there are those of the map.
#[test]
fn hairs_are_mapped_where_they_are_projected() {
    let views = views();
    for kind in ["straight", "curly"] {
        let loaded = loaded(kind);
        let all = loaded.draw(StrandOptions::default(), &()).unwrap().strands;
        let Some(AttributeValues::U32(guides)) = all.attribute("guide").map(|a| &a.values) else {
            panic!("hairs have guides")
        };
        let viewed = Viewed::new(&loaded, &views, &()).unwrap();
        for camera in &views.cameras {
            let view = viewed.view(camera, &()).unwrap();
            assert_eq!((view.color.len(), view.pixels.len()), (160 * 200 * 4, 160 * 200));
            let (mut hairs, mut aligned) = (0, 0);
            for (index, pixel) in view.pixels.iter().enumerate() {
                let Some(hair) = pixel.strand else { continue };
                hairs += 1;
                assert_eq!(viewed.guide(hair.index), Some(guides[hair.index as usize]));
                let place = DVec2::new((index % 160) as f64, (index / 160) as f64);
                let strand = all.strand(hair.index as usize);
                let near: Vec<Passing> = passings(&view.camera, &strand, place)
                    .into_iter()
                    .filter(|p| p.distance < 1.0)
                    .collect();
                assert!(
                    !near.is_empty(),
                    "{kind} {}: {place} is no pixel of its hair",
                    camera.name
                );
                // The surface of the widened hair, at most 0.7 pixels aside.
                let radius = f64::from(viewed.width() * strand.radii[0]);
                let off = |p: &Passing| (p.depth - f64::from(pixel.depth)).abs() - p.slope;
                let least = near.iter().map(off).fold(f64::INFINITY, f64::min);
                assert!(least < 3.0 * radius, "{kind} {}: {place} is {least} m off", camera.name);
                let direction = DVec2::new(hair.direction[0].into(), hair.direction[1].into());
                let along = near.iter().any(|p| p.direction.dot(direction) > 0.97);
                aligned += usize::from(along);
            }
            assert!(hairs > 1500, "{kind} {}: {hairs}", camera.name);
            // Curves turn between two points of a strand, most where they run along the view.
            assert!(aligned * 100 > hairs * 95, "{kind} {}: {aligned} of {hairs}", camera.name);
        }
    }
}
