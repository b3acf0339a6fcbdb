//! What the natural curl does to one hair: how far it hangs down, and how stable it is.
//!
//! `cargo run --release -p frisure --example what_curl_does`

#![expect(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;

use frisure::rod::equilibrium;
use frisure::scene::Scene;

fn main() -> Result<(), Box<dyn Error>> {
    println!(
        "a hair of 20 cm that leaves the scalp sideways, curled about a circle of some radius"
    );
    println!(
        "{:>9} {:>7} {:>10} {:>9} {:>11} {:>12}",
        "radius", "turns", "tip below", "reach", "eigenvalue", "error"
    );
    for radius in [200.0, 100.0, 50.0, 20.0, 10.0, 5.0, 3.0, 2.0] {
        // 1. The fibre: that of a hair type, with a curl whose pitch is twice its radius (mm).
        let text = format!(
            r#"
                [hair]
                type = "caucasian-curly"
                length = "20 cm"
                curl = {{ radius = "{radius} mm", pitch = "{} mm" }}
            "#,
            2.0 * radius
        );
        let hair = Scene::parse("curl.toml", text, "".as_ref())?.single_hair()?;
        let turns = hair.rod.natural().max_magnitude(hair.rod.length()) * hair.rod.length()
            / std::f64::consts::TAU;

        // 2. Its equilibrium in its own weight.
        let rest = equilibrium(&hair.rod, &[], &hair.options);

        // 3. The smallest eigenvalue of the second variation is 1 without loads, and 0 where stability is lost.
        println!(
            "{radius:>6} mm {turns:>7.1} {:>7.1} cm {:>6.1} cm {:>11.3} {:>9.1e} m",
            -100.0 * rest.tip().z,
            100.0 * rest.tip().length(),
            rest.certificate.min_eigenvalue.unwrap_or(f64::NAN),
            rest.error_estimate.unwrap_or(f64::NAN),
        );
    }
    Ok(())
}
