//! Which wisps a step is done to.

use frisure_hairstyle::head::Region;
use frisure_hairstyle::styling::{Lasso, Selection, Spot, StyleError, View};
use frisure_hairstyle::{Place, selected};
use glam::DVec3;

use crate::{HEAD, hairstyle};

#[test]
fn a_lasso_takes_what_is_seen_in_it_and_a_brush_what_is_rooted_under_it() {
    let hair = hairstyle("straight", 150);
    let marks = HEAD.landmarks();
    let side = |left: f64, through: bool| {
        let view = View {
            eye: marks.cranium_centre + DVec3::new(0.0, -1.0, 0.05),
            target: marks.cranium_centre,
            field_of_view: 0.6,
            aspect: 1.0,
        };
        let polygon = vec![[0.0, -9.0], [9.0 * left, -9.0], [9.0 * left, 9.0], [0.0, 9.0]];
        let lasso = Selection::Lasso(Lasso { view, polygon, through });
        selected(&hair, &HEAD, &lasso).unwrap()
    };
    let (left, right, through) = (side(1.0, false), side(-1.0, false), side(1.0, true));
    let count = |chosen: &[bool]| chosen.iter().filter(|c| **c).count();
    assert!(count(&left) > 10 && count(&right) > 10);
    // The head's left is on the right of a picture of its face.
    for (i, rest) in hair.equilibria().iter().enumerate() {
        let x: f64 = rest.centre_line(20).iter().map(|p| p.x).sum::<f64>() / 20.0;
        assert!(!(left[i] && right[i]));
        assert!(!left[i] || x > -0.01, "{x}");
    }
    assert!(count(&through) > count(&left), "the head hides some");
    let brush = |spot: Spot| {
        let brush = Selection::Brush { spots: vec![spot], radius: 0.03 };
        selected(&hair, &HEAD, &brush).unwrap()
    };
    let near = brush(Spot::At(marks.whorl + DVec3::Z * 0.05));
    for (near, guide) in near.iter().zip(hair.guides()) {
        let distance = guide.root.position.distance(marks.whorl);
        assert!(*near == (distance < 0.03) || (distance - 0.03).abs() < 0.02, "{distance}");
    }
    assert!(count(&near) > 0 && count(&brush(Spot::Tape([0.0, 0.05]))) > 0);
    let both = Selection::All(vec![Selection::Place(Place::Left), Selection::Place(Place::Right)]);
    assert_eq!(selected(&hair, &HEAD, &both), Err(StyleError::NothingSelected));
    let all = Selection::Any(vec![
        Selection::Wisps(vec![3]),
        Selection::Not(Box::new(Selection::Wisps(vec![3]))),
    ]);
    assert_eq!(count(&selected(&hair, &HEAD, &all).unwrap()), 150);
}

#[test]
fn a_mirrored_selection_has_the_wisps_rooted_on_the_other_side() {
    let hair = hairstyle("caucasian-straight", 150);
    let temple = HEAD.landmarks().ear + DVec3::new(0.0, -0.02, 0.04);
    let sphere = |centre: DVec3| Selection::Brush { spots: vec![Spot::At(centre)], radius: 0.05 };
    let beside = Selection::Beyond { point: DVec3::X * 0.02, normal: DVec3::new(1.0, 0.2, 0.3) };
    let half = Selection::Not(Box::new(Selection::Place(Place::LeftOf(Region::Fringe))));
    let chosen = [sphere(temple), beside, half];
    for selection in chosen.iter().chain([&Selection::All(chosen.to_vec())]) {
        let other = selection.mirrored(&|wisp| wisp);
        assert_eq!(other.mirrored(&|wisp| wisp), *selection);
        let (here, there) = (selected(&hair, &HEAD, selection), selected(&hair, &HEAD, &other));
        let mean = |chosen: &[bool]| {
            let roots = hair.guides().iter().zip(chosen).filter(|(_, chosen)| **chosen);
            let (sum, n) = roots.fold((DVec3::ZERO, 0.0), |(sum, n), (guide, _)| {
                (sum + guide.root.position, n + 1.0)
            });
            sum / n
        };
        let (here, there) = (mean(&here.unwrap()), mean(&there.unwrap()));
        // The roots themselves are not symmetric: 150 of them are 2 cm apart.
        assert!(
            (here.x + there.x).abs() < 0.01 && (here - there).with_x(0.0).length() < 0.01,
            "{here} {there}"
        );
    }
    let (numbers, opposite) = (Selection::Wisps(vec![3, 4, 9]), |wisp| 12 - wisp / 2 * 2);
    assert_eq!(numbers.mirrored(&opposite), Selection::Wisps(vec![4, 8, 10]));
}
