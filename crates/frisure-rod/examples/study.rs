//! scratch study
use frisure_rod::minimise::*;
use frisure_rod::*;
use glam::DVec3;
use serde_json::Value;
fn v3(v: &Value) -> DVec3 { DVec3::new(v[0].as_f64().unwrap(), v[1].as_f64().unwrap(), v[2].as_f64().unwrap()) }
fn main() {
    let text = std::fs::read_to_string("/work/shared/data/rod_reference_cases.json").unwrap();
    let data: Value = serde_json::from_str(&text).unwrap();
    for case in data["cases"].as_array().unwrap() {
        let p = &case["params"];
        let f = |k: &str| p[k].as_f64().unwrap();
        let rod = Rod::new(RodSpec {
            length: f("L"),
            section: Section::from_semi_axes(f("semi_axis_a_d1"), f("semi_axis_b_d2")).unwrap(),
            material: Material::new(f("E"), f("G"), f("rho")).unwrap(),
            torsion: if p["J_kind"] == "polar" { TorsionConstant::Polar } else { TorsionConstant::SaintVenant },
            natural: NaturalStrain::Uniform(DVec3::new(f("kappa1_0"), f("kappa2_0"), f("tau_0"))),
            root: Root::new(DVec3::ZERO, v3(&p["root_d1"]), v3(&p["root_d2"]), v3(&p["root_t"])).unwrap(),
            gravity: f("g"),
        }).unwrap();
        let tip = v3(&case["result"]["tip"]);
        let turns = rod.natural().at(0.0).length() * rod.length() / std::f64::consts::TAU;
        println!("{} G={:.3} turns={:.2}", case["name"], rod.heaviness(), turns);
        for kind in [ElementKind::Helix, ElementKind::Jointed] {
            print!("   {kind:?}: ");
            let mut previous: Option<DVec3> = None;
            for n in [15, 30, 60, 120, 240] {
                let chain = Chain::uniform(&rod, kind, n);
                let problem = Problem::new(&chain, &[]);
                let m = Riccati::default().minimise(&problem, chain.natural_shape(), Stopping { tolerance: 1e-11, max_iterations: 500 });
                let r = *m.shape.positions.last().unwrap();
                let ex = previous.map_or(f64::NAN, |q| ((4.0 * r - q) / 3.0 - tip).length() / rod.length());
                print!("{:.1e}({:.0e}) it{} {}| ", (r - tip).length() / rod.length(), ex, m.iterations, match m.stability { Stability::Stable => "", Stability::Saddle => "SADDLE", _ => "NOTCONV" });
                previous = Some(r);
            }
            println!();
        }
    }
}
