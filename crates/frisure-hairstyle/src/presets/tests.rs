use super::*;
use crate::head::test_shapes::mannequin;

fn hair(name: &str) -> HairType {
    *preset(name).unwrap().hair_type()
}

fn of(population: &str) -> Vec<&'static Preset> {
    let found: Vec<_> = PRESETS.iter().filter(|p| p.name.starts_with(population)).collect();
    assert!(found.len() >= 2);
    found
}

#[test]
fn every_preset_is_valid_and_found_by_name() {
    for (i, p) in PRESETS.iter().enumerate() {
        assert_eq!(p.spec().check(), Ok(()), "{}", p.name);
        assert_eq!(preset(p.name), Some(p));
        assert!(PRESETS[..i].iter().all(|other| other.description != p.description));
        assert!(p.hair_type().fibre(Ellipticity::Paper).is_ok());
    }
    assert_eq!(preset("no-such"), None);
}

/// What is measured of a population.
struct Measured {
    name: &'static str,
    /// Hairs per cm² and growth in µm a day: Loussouarn, El Rawadi & Genain (2005).
    density: f64,
    growth: f64,
    /// Smallest and largest mean among the sources in `docs/hair-types.md`: diameter (µm) and axis
    /// ratio.
    diameter: [f64; 2],
    ratio: [f64; 2],
}

const MEASURED: [Measured; 3] = [
    Measured {
        name: "african",
        density: 161.0,
        growth: 280.0,
        diameter: [73.2, 78.0],
        ratio: [1.66, 2.01],
    },
    Measured {
        name: "caucasian",
        density: 226.0,
        growth: 367.0,
        diameter: [57.1, 74.0],
        ratio: [1.40, 1.56],
    },
    Measured {
        name: "asian",
        density: 175.0,
        growth: 411.0,
        diameter: [80.3, 90.0],
        ratio: [1.20, 1.29],
    },
];

#[test]
fn populations_have_their_measured_numbers() {
    for Measured { name, density, growth, diameter, ratio } in MEASURED {
        for p in of(name) {
            let h = p.hair_type();
            assert!((h.density * 1e-4 - density).abs() < 1e-9, "{}", p.name);
            assert!((h.growth_rate * 86_400.0 * 1e6 - growth).abs() < 1e-9, "{}", p.name);
            assert!((diameter[0]..=diameter[1]).contains(&(h.diameter * 1e6)), "{}", p.name);
            assert!((ratio[0]..=ratio[1]).contains(&h.axis_ratio), "{}", p.name);
        }
    }
}

#[test]
fn eccentricities_are_those_of_the_paper() {
    for (population, largest) in [("african", 0.2), ("caucasian", 0.1), ("asian", 0.0)] {
        for p in of(population) {
            let h = p.hair_type();
            assert!(h.paper_eccentricity <= largest, "{}", p.name);
            let section = h.fibre(Ellipticity::Paper).unwrap().section;
            assert!((section.eccentricity() - h.paper_eccentricity).abs() < 1e-7);
            assert!((2.0 * section.mean_radius() / h.diameter - 1.0).abs() < 1e-12);
            // What the paper calls elliptical is a circle to 2 %.
            assert!(section.axis_ratio() < 1.021);
        }
    }
}

#[test]
fn what_is_the_same_for_all_hair_is_in_its_measured_range() {
    for p in PRESETS {
        let h = p.hair_type();
        // Robbins 2012: 3.89 and 0.89 GPa; others 3–4 and 0.8–0.9 GPa.
        assert!((3e9..=4e9).contains(&h.youngs_modulus));
        assert!((0.795e9..=0.9e9).contains(&h.shear_modulus));
        assert!((1300.0..=1320.0).contains(&h.mass_density));
        // Loussouarn et al. 2016: 0.8 to 1.3 cm a month, 159 to 233 hairs per cm².
        let month = h.growth_rate * 100.0 * 30.44 * 86_400.0;
        assert!((0.79..=1.31).contains(&month), "{}: {month}", p.name);
        assert!((159e4..=233e4).contains(&h.density), "{}", p.name);
        // Water softens hair by less than the paper says in tension, and more in torsion.
        let (measured, paper) = (h.wetting, h.paper_wetting);
        assert!((1.0 / 2.6..=1.0 / 2.0).contains(&measured.youngs_modulus));
        assert!(measured.shear_modulus < measured.youngs_modulus);
        assert!(paper.youngs_modulus < measured.youngs_modulus);
        assert_eq!((paper.diameter, paper.length), (1.13, 1.01));
        assert!((1.0..=1.139).contains(&measured.diameter));
        assert!((1.0..=1.0186).contains(&measured.length));
    }
}

#[test]
fn curl_types_are_in_their_classes() {
    // Curve diameters (m) from above to below: de la Mettrie et al. 2007. Types IV to VIII share the
    // last class and differ by curl index, waves and twists.
    let classes =
        [(0.105, f64::INFINITY), (0.055, 0.105), (0.035, 0.055), (0.0, 0.035), (0.0, 0.035)];
    let mut previous = f64::INFINITY;
    let mut index = 1.0;
    for number in 1..=8 {
        let curl = hair(&format!("type-{number}")).curl;
        let (least, most) = classes[(number - 1).min(4)];
        let diameter = curl.curve_diameter();
        assert!(diameter > least && diameter <= most, "type {number}: {diameter}");
        assert!(diameter < previous, "type {number}");
        if number > 1 {
            assert!(curl.curl_index() > index, "type {number}");
            index = curl.curl_index();
        }
        previous = diameter;
    }
}

#[test]
fn words_are_in_the_bins_of_a_measured_population() {
    // By radius of curvature (m): Lasisi et al. 2021.
    let radius = |name| 0.5 * hair(name).curl.curve_diameter();
    assert!(radius("straight") > 0.054);
    assert!((0.0285..=0.054).contains(&radius("wavy")));
    assert!((0.006..=0.0285).contains(&radius("curly")));
    for name in ["coily", "kinky", "frizzy", "african-coily", "african-kinky"] {
        assert!(radius(name) <= 0.006, "{name}");
    }
    // Very curly: 0.153 to 0.560 per mm, from the 10th to the 90th percentile.
    for name in ["coily", "kinky", "african-coily", "african-kinky"] {
        assert!((153.0..=560.0).contains(&hair(name).curl.curvature()), "{name}");
    }
    // Japanese hair has 0.6 to 16 cm, of which typical curved hair up to 2.5 cm (Nagase et al.
    // 2008).
    assert!((0.006..=0.025).contains(&radius("asian-wavy")));
    assert!((0.025..=0.16).contains(&radius("asian-straight")));
}

#[test]
fn a_natural_curl_measures_itself() {
    let curl = NaturalCurl {
        radius: 0.01,
        pitch: 0.03,
        variation_between: 0.0,
        variation_along: 0.0,
        variation_scale: 0.03,
    };
    let strain = curl.curl().unwrap().strain;
    assert!((strain.truncate().length() / curl.curvature() - 1.0).abs() < 1e-12);
    let turn = 1.0 / curl.turns_per_length();
    assert!((turn * strain.length() / std::f64::consts::TAU - 1.0).abs() < 1e-12);
    assert!((turn / curl.pitch / curl.curl_index() - 1.0).abs() < 1e-12);
    // A ring is as wide as it is measured.
    let ring = NaturalCurl { pitch: 0.0, ..curl };
    assert!((ring.curve_diameter() - 0.02).abs() < 1e-15);
}

#[test]
fn a_scalp_has_as_many_hairs_as_its_density_says() {
    let spec = preset("caucasian-straight").unwrap().spec();
    let area = crate::scalp_area(&spec, mannequin());
    let wisps = spec.wisps;
    let hairs = wisps.hair_count(area);
    assert!((hairs as f64 / (226e4 * area) - 1.0).abs() < 1e-4, "{hairs}");
    // People have 90 000 to 150 000 hairs, blond ones most.
    for p in PRESETS {
        let hairs = p.spec().wisps.hair_count(area);
        assert!((80_000..=150_000).contains(&hairs), "{}: {hairs}", p.name);
    }
    let count = wisps.count as f64;
    assert!((wisps.hairs_per_wisp(area) * count - hairs as f64).abs() < 1e-6);
    let by = |hairs| Wisps { hairs, ..wisps };
    assert_eq!(by(Hairs::Count(7)).hair_count(area), 7);
    assert_eq!(by(Hairs::PerWisp(7)).hair_count(area), 7 * wisps.count);
    assert_eq!(by(Hairs::Density(1e4)).hair_count(1e-9), 1);
}
