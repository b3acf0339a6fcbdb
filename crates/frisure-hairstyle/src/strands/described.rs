//! Attributes of strands for grooming programs: the guides that each follows, where it is rooted, and its
//! fibre.

use frisure_rod::Equilibrium;
use frisure_strands::{AttributeValues, Domain, Strands, names};
use glam::DVec3;

use super::attributes::put;
use super::population::{Population, roots};
use crate::guides::Guide;
use crate::hairstyle::Hairstyle;
use crate::head::{Head, Region, Texture};
use crate::parallel;

/// Adds to all drawn hairs of a hairstyle what programs that groom want to know: `closest_guides`,
/// `guide_weights`, `id`, `group` and `root_uv`, as [`names`] has them.
///
/// The texture coordinates of a root are those of the skin beneath it, of the mesh [`textured`](crate::head::textured).
///
/// # Panics
/// If they have been added before, or these are not all drawn hairs.
pub fn describe(strands: &mut Strands, hairstyle: &Hairstyle, head: &Head) {
    let population = Population::new(hairstyle, head);
    let marks = head.landmarks();
    let roots = roots(hairstyle, head, 1);
    let followed =
        parallel::map_slice(&roots, |(index, root)| most(&population.followed(root, *index)));
    let (closest, weights) = followed.into_iter().unzip();
    let group = |p: DVec3| group(marks.region(p));
    let ids = roots.iter().map(|(index, _)| *index as u32).collect();
    let groups = roots.iter().map(|(_, root)| group(root.position)).collect();
    let texture = Texture::new(head);
    let uvs = parallel::map_slice(&roots, |(_, root)| texture.at(root.position));
    put(strands, Domain::Strand, names::CLOSEST_GUIDES, AttributeValues::U32x3(closest));
    put(strands, Domain::Strand, names::GUIDE_WEIGHTS, AttributeValues::F32x3(weights));
    put(strands, Domain::Strand, names::ID, AttributeValues::U32(ids));
    put(strands, Domain::Strand, names::GROUP, AttributeValues::U32(groups));
    put(strands, Domain::Strand, names::ROOT_UV, AttributeValues::F32x2(uvs));
}

/// Adds to drawn hairs the natural strains (rad/m) of the guides that they follow, `natural_strain`, each at
/// the same distance from the root.
///
/// # Panics
/// If they have been added before.
pub fn add_natural_strains(strands: &mut Strands, hairstyle: &Hairstyle) {
    let Some(AttributeValues::U32(guides)) = strands.attribute(names::GUIDE).map(|a| &a.values)
    else {
        return;
    };
    let strains = parallel::map(guides.len(), |strand| -> Vec<[f32; 3]> {
        let line = strands.strand(strand).points;
        let natural = hairstyle.guides[guides[strand] as usize].rod.natural();
        let mut s = 0.0;
        let at = |k: usize| {
            s += if k > 0 { f64::from(line[k - 1].distance(line[k])) } else { 0.0 };
            natural.at(s).as_vec3().to_array()
        };
        (0..line.len()).map(at).collect()
    });
    let values = AttributeValues::F32x3(strains.concat());
    put(strands, Domain::Point, names::NATURAL_STRAIN, values);
}

/// The guides as strands of `points` points, at least 2, with the attribute `guide`.
#[must_use]
pub fn guide_strands(hairstyle: &Hairstyle, points: usize) -> Strands {
    let guides = &hairstyle.rest.guides;
    let mut strands = Strands::new();
    for guide in guides {
        let radii = vec![guide.rod.spec().section.mean_radius() as f32; points.max(2)];
        let line: Vec<_> = guide.centre_line(points).iter().map(|p| p.as_vec3()).collect();
        strands.push(&line, &radii);
    }
    let values = AttributeValues::U32((0..guides.len() as u32).collect());
    put(&mut strands, Domain::Strand, names::GUIDE, values);
    strands
}

/// The guides as strands of `points` points, at least 2, with `id`, `group`, `root_uv`, `axis_ratio`, `d1`,
/// `natural_strain`, and `wetness` if any is wet.
#[must_use]
pub fn described_guides(hairstyle: &Hairstyle, head: &Head, points: usize) -> Strands {
    let mut strands = guide_strands(hairstyle, points);
    let Hairstyle { guides, rest, .. } = hairstyle;
    let texture = Texture::new(head);
    let of = |f: &dyn Fn(&Guide) -> u32| AttributeValues::U32(guides.iter().map(f).collect());
    let ids = AttributeValues::U32((0..guides.len() as u32).collect());
    let uv = |g: &Guide| texture.at(g.root.position);
    let uvs = AttributeValues::F32x2(guides.iter().map(uv).collect());
    let ratio = |g: &Guide| (g.rod.spec().section.a() / g.rod.spec().section.b()) as f32;
    let ratios = AttributeValues::F32(guides.iter().map(ratio).collect());
    put(&mut strands, Domain::Strand, names::ID, ids);
    put(&mut strands, Domain::Strand, names::GROUP, of(&|g| group(g.region)));
    put(&mut strands, Domain::Strand, names::ROOT_UV, uvs);
    put(&mut strands, Domain::Strand, names::AXIS_RATIO, ratios);

    let along = |f: &(dyn Fn(&Equilibrium) -> Vec<[f32; 3]> + Sync)| {
        AttributeValues::F32x3(parallel::map_slice(&rest.guides, f).concat())
    };
    let directors = |guide: &Equilibrium| {
        let frames = guide.sample(points.max(2));
        frames.iter().map(|(_, frame)| frame.x_axis.as_vec3().to_array()).collect()
    };
    let strains = |guide: &Equilibrium| {
        let (count, length) = (points.max(2), guide.rod.length());
        let place = |k: usize| length * k as f64 / (count - 1) as f64;
        (0..count).map(|k| guide.rod.natural().at(place(k)).as_vec3().to_array()).collect()
    };
    put(&mut strands, Domain::Point, names::DIRECTOR, along(&directors));
    put(&mut strands, Domain::Point, names::NATURAL_STRAIN, along(&strains));
    let wisps = hairstyle.wisps();
    if wisps.iter().any(|wisp| wisp.wetness != 0.0) {
        let wetness = wisps.iter().map(|wisp| wisp.wetness as f32);
        let values = wetness.flat_map(|w| std::iter::repeat_n(w, points.max(2))).collect();
        put(&mut strands, Domain::Point, names::WETNESS, AttributeValues::F32(values));
    }
    strands
}

/// The three guides that a hair follows most, and how much; one that follows fewer has its own more than
/// once, with weight 0.
fn most(followed: &[(usize, f64)]) -> ([u32; 3], [f32; 3]) {
    let own = followed[0].0;
    let mut others: Vec<(usize, f64)> = followed[1..].to_vec();
    others.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let second = others.first().copied().unwrap_or((own, 0.0));
    let third = others.get(1).copied().unwrap_or((own, 0.0));
    let all = [followed[0], second, third];
    let sum: f64 = all.iter().map(|f| f.1).sum();
    (all.map(|f| f.0 as u32), all.map(|f| (f.1 / sum) as f32))
}

/// The number of a region, as [`names::GROUP`] has it.
fn group(region: Region) -> u32 {
    Region::ALL.iter().position(|r| *r == region).unwrap_or(0) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::textured;
    use crate::{Hairs, PRESETS, PredictOptions, StrandOptions, predict, strands};
    use frisure_strands::Surface;
    use glam::DVec2;

    fn small() -> (Hairstyle, Head) {
        let mut spec = PRESETS[0].spec();
        spec.wisps.count = 24;
        spec.wisps.hairs = Hairs::Count(300);
        let head = Head::mannequin();
        (predict(&spec, &head, PredictOptions::default(), &()).unwrap(), head)
    }

    #[test]
    fn weights_are_shares() {
        let (hairstyle, head) = small();
        let drawn = strands(&hairstyle, &head, StrandOptions::default(), &());
        let mut strands = drawn.unwrap().strands;
        describe(&mut strands, &hairstyle, &head);
        let values = |name: &str| &strands.attribute(name).unwrap().values;
        let AttributeValues::F32x3(weights) = values(names::GUIDE_WEIGHTS) else { panic!() };
        let AttributeValues::U32x3(closest) = values(names::CLOSEST_GUIDES) else { panic!() };
        let AttributeValues::U32(own) = values(names::GUIDE) else { panic!() };
        for ((weights, closest), own) in weights.iter().zip(closest).zip(own) {
            assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-6);
            assert_eq!(closest[0], *own);
            assert!(closest.iter().all(|g| (*g as usize) < hairstyle.guides().len()));
        }
    }

    /// The points of the skin with these texture coordinates, each place once.
    fn places(surface: &Surface, uv: [f32; 2]) -> Vec<DVec3> {
        let uv = DVec2::new(uv[0].into(), uv[1].into());
        let mut found: Vec<DVec3> = Vec::new();
        for (face, corners) in surface.texture().iter().enumerate() {
            let [a, b, c] = corners.map(|t| DVec2::new(t[0].into(), t[1].into()));
            let area = (b - a).perp_dot(c - a);
            let weights =
                [(b - uv).perp_dot(c - uv), (c - uv).perp_dot(a - uv), (a - uv).perp_dot(b - uv)];
            let weights = weights.map(|w| w / area);
            // Up to the rounding of single precision: a root may be on an edge.
            if area != 0.0 && weights.iter().all(|w| *w > -1e-4) {
                let place = (0..3).map(|i| surface.corners(face)[i] * weights[i]).sum::<DVec3>();
                if found.iter().all(|other| other.distance(place) > 2e-4) {
                    found.push(place);
                }
            }
        }
        found
    }

    #[test]
    fn the_skin_at_the_texture_coordinates_of_a_root_is_beneath_the_root() {
        let (hairstyle, head) = small();
        let drawn = strands(&hairstyle, &head, StrandOptions::default(), &());
        let mut strands = drawn.unwrap().strands;
        describe(&mut strands, &hairstyle, &head);
        let guides = described_guides(&hairstyle, &head, 9);
        let surface = textured(&head);
        // Where hair leaves the skin; the first points of drawn hairs are a little deeper, in the skin.
        let own = roots(&hairstyle, &head, 1).into_iter().map(|(_, root)| root.position).collect();
        let of_guides: Vec<DVec3> = hairstyle.guides().iter().map(|g| g.root.position).collect();
        for (all, roots) in [(&strands, own), (&guides, of_guides)] {
            let values = &all.attribute(names::ROOT_UV).unwrap().values;
            let AttributeValues::F32x2(uvs) = values else { panic!() };
            assert_eq!(uvs.len(), roots.len());
            for (root, uv) in roots.into_iter().zip(uvs) {
                let found = places(&surface, *uv);
                assert_eq!(found.len(), 1, "{uv:?} is at {found:?}");
                let gap = found[0].distance(root);
                assert!(gap < 1e-4, "the root is {gap} m from the skin at {uv:?}");
                assert!(uv.iter().all(|x| (0.0..=1.0).contains(x)), "{uv:?}");
            }
        }
    }

    #[test]
    fn guides_know_their_fibre() {
        let (hairstyle, head) = small();
        let guides = described_guides(&hairstyle, &head, 257);
        let d1 = guides.attribute(names::DIRECTOR).unwrap();
        let AttributeValues::F32x3(d1) = &d1.values else { panic!() };
        for (i, strand) in guides.iter().enumerate() {
            let first = (strand.points[1] - strand.points[0]).normalize();
            let director = glam::Vec3::from_array(d1[257 * i]);
            assert!(director.is_normalized());
            // It is across the hair, up to what a chord of a millimetre turns.
            assert!(director.dot(first).abs() < 0.1, "{i}: {}", director.dot(first));
        }
    }
}
