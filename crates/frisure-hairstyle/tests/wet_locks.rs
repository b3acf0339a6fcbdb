//! Locks of wet hair: drawn hairs gather as the law of capillarity says. That hairs meet where the law has it is shown in the evidence.

use std::sync::LazyLock;

use frisure_hairstyle::head::Head;
use frisure_hairstyle::styling::{Cut, CutLine, Dry, Operation, Wet};
use frisure_hairstyle::{
    Hairs, Hairstyle, HairstyleSpec, PredictOptions, StrandOptions, StyleOptions, WetLockSizes,
    WetLocks, predict, preset, strands, style,
};
use frisure_strands::Strands;
use glam::DVec3;

static HEAD: LazyLock<Head> = LazyLock::new(Head::mannequin);

/// Three quarters of the hair (m), where locks are counted.
const OUT: f64 = 0.75 * 0.3;

fn spec(name: &str) -> HairstyleSpec {
    let mut spec = preset(name).unwrap().spec();
    spec.length.mean = 0.3;
    spec.wisps.count = 80;
    spec.wisps.hairs = Hairs::Count(16_000);
    spec.wetting.locks = WetLocks::Capillary;
    spec
}

fn done(before: &Hairstyle, operation: &Operation) -> Hairstyle {
    style(before, &HEAD, operation, StyleOptions::default(), &()).unwrap()
}

fn wet(to: f64) -> Operation {
    Operation::Wet(Wet { to, ..Wet::default() })
}

fn drawn(hair: &Hairstyle) -> Strands {
    strands(hair, &HEAD, StrandOptions::default(), &()).unwrap().strands
}

/// The place of a strand at a distance (m) along it, or its tip.
fn place(strands: &Strands, strand: usize, along: f64) -> DVec3 {
    let points = strands.strand(strand).points;
    let mut left = along as f32;
    for pair in points.windows(2) {
        let step = pair[0].distance(pair[1]);
        if left <= step {
            return pair[0].lerp(pair[1], left / step).as_dvec3();
        }
        left -= step;
    }
    points[points.len() - 1].as_dvec3()
}

/// How far (m) the place of a strand at a distance along it is from the line of another: hairs slide along each other.
fn apart(strands: &Strands, [strand, other]: [usize; 2], along: f64) -> f64 {
    let p = place(strands, strand, along);
    let to = |pair: &[glam::Vec3]| {
        let (a, b) = (pair[0].as_dvec3(), pair[1].as_dvec3());
        let t = ((p - a).dot(b - a) / (b - a).length_squared().max(1e-18)).clamp(0.0, 1.0);
        p.distance(a.lerp(b, t))
    };
    strands.strand(other).points.windows(2).map(to).fold(f64::INFINITY, f64::min)
}

/// For each strand the four whose roots are nearest.
fn beside(strands: &Strands) -> Vec<[usize; 4]> {
    let roots: Vec<DVec3> = (0..strands.len()).map(|i| place(strands, i, 0.0)).collect();
    let nearest = |i: usize| {
        let mut far: Vec<(f64, usize)> = (0..roots.len())
            .filter(|&j| j != i)
            .map(|j| (roots[j].distance_squared(roots[i]), j))
            .collect();
        far.select_nth_unstable_by(3, |a, b| a.0.total_cmp(&b.0));
        [far[0].1, far[1].1, far[2].1, far[3].1]
    };
    (0..roots.len()).map(nearest).collect()
}

/// Distances (m) of strands that are rooted beside each other, sorted.
fn distances(strands: &Strands, beside: &[[usize; 4]], along: f64) -> Vec<f64> {
    let of = |(i, others): (usize, &[usize; 4])| others.map(|j| apart(strands, [i, j], along));
    let mut all: Vec<f64> = beside.iter().enumerate().flat_map(of).collect();
    all.sort_by(f64::total_cmp);
    all
}

fn median(sorted: &[f64]) -> f64 {
    sorted[sorted.len() / 2]
}

#[test]
fn wet_hairs_lie_in_locks_and_dry_apart() {
    let dry = predict(&spec("caucasian-straight"), &HEAD, PredictOptions::default(), &()).unwrap();
    let before = drawn(&dry);
    let beside = beside(&before);
    let soaked = done(&dry, &wet(1.0));
    let damp = done(&dry, &wet(0.02));
    let WetLockSizes { hairs_per_lock, radius, meeting, hairs } = soaked.wet_locks().unwrap();
    // As photographs of wet hair of that length show them: pencils and thinner.
    assert!((1e-3..4e-3).contains(&radius), "{radius}");
    assert!((hairs / soaked.grown() - 1.0).abs() < 1e-12);

    // 1. At the skin nothing changes. The first point is the same; the next is a hundredth of the way on.
    let soaked_hair = drawn(&soaked);
    let [at_root, was] = [&soaked_hair, &before].map(|hair| median(&distances(hair, &beside, 0.0)));
    assert!((at_root / was - 1.0).abs() < 0.01);

    // 2. Most hairs that are rooted beside each other lie as close as hairs in a lock do.
    // Drawn hairs are fewer: they have the distances of as many in the same lock.
    let per_lock = hairs_per_lock * 16_000.0 / hairs;
    let touching = radius / per_lock.sqrt();
    let far_out = distances(&soaked_hair, &beside, OUT);
    let dry_out = median(&distances(&before, &beside, OUT));
    let wet_out = median(&far_out);
    assert!(
        wet_out < 3.0 * touching && wet_out < 0.4 * dry_out,
        "{wet_out}, {touching}, {dry_out}"
    );

    // 3. Locks are as many as the law says. Roots side by side whose hairs are close belong to the same.
    let mut lock: Vec<usize> = (0..before.len()).collect();
    fn of(lock: &mut [usize], i: usize) -> usize {
        if lock[i] != i {
            lock[i] = of(lock, lock[i]);
        }
        lock[i]
    }
    for (i, others) in beside.iter().enumerate() {
        for &j in others {
            if apart(&soaked_hair, [i, j], OUT) < 2.0 * radius {
                let (a, b) = (of(&mut lock, i), of(&mut lock, j));
                lock[a] = b;
            }
        }
    }
    let mut sizes = vec![0; before.len()];
    for i in 0..before.len() {
        sizes[of(&mut lock, i)] += 1;
    }
    let count = sizes.iter().filter(|&&size| f64::from(size) > 0.2 * per_lock).count() as f64;
    let expected = hairs / hairs_per_lock;
    assert!((0.5..2.0).contains(&(count / expected)), "{count} {expected}");

    // 4. With less water hairs meet farther out, and dry hair is as it was, to the last bit.
    let damp_locks = damp.wet_locks().unwrap();
    assert!(damp_locks.hairs_per_lock <= hairs_per_lock);
    assert!(damp_locks.meeting.unwrap() > meeting.unwrap());
    let dried = done(&soaked, &Operation::Dry(Dry::default()));
    assert_eq!(dried.wet_locks(), None);
    assert!(drawn(&dried) == before);
}

#[test]
fn a_cut_leaves_locks_where_they_are() {
    let mut spec = spec("caucasian-straight");
    spec.wisps.hairs = Hairs::Count(2_000);
    let dry = predict(&spec, &HEAD, PredictOptions::default(), &()).unwrap();
    let soaked = done(&dry, &wet(1.0));
    let line = CutLine::Length(0.25);
    let cut = Cut { line, ..Cut::default() };
    let shorter = done(&soaked, &Operation::Cut(cut));
    let (long, short) = (drawn(&soaked), drawn(&shorter));
    // Half-way along, hairs that lay side by side still do.
    let beside = beside(&long);
    let close = |strands: &Strands, i: usize, j: usize| apart(strands, [i, j], 0.12) < 1e-3;
    let pairs = beside.iter().enumerate().flat_map(|(i, others)| others.map(|j| (i, j)));
    let joined: Vec<(usize, usize)> = pairs.filter(|&(i, j)| close(&long, i, j)).collect();
    let still = joined.iter().filter(|&&(i, j)| close(&short, i, j)).count();
    assert!(joined.len() > 2000 && still as f64 > 0.9 * joined.len() as f64);
}

#[test]
fn tight_curls_form_small_locks_and_nothing_does_by_the_papers_law() {
    let of = |name: &str| {
        let mut spec = spec(name);
        spec.length.mean = 0.1;
        spec.wisps.hairs = Hairs::Count(200);
        spec
    };
    let soaked = |spec: &HairstyleSpec| {
        done(&predict(spec, &HEAD, PredictOptions::default(), &()).unwrap(), &wet(1.0))
    };
    let straight = soaked(&of("caucasian-straight")).wet_locks().unwrap();
    let kinky = soaked(&of("african-kinky")).wet_locks().unwrap();
    assert!(kinky.hairs_per_lock < 0.3 * straight.hairs_per_lock);
    let mut paper = of("caucasian-straight");
    paper.wetting.locks = WetLocks::Factor;
    assert_eq!(soaked(&paper).wet_locks(), None);
}
