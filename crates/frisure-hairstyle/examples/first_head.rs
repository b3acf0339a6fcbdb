//! Predicts a small head of curly hair, wets it, cuts it, dries it, and prints how it hangs.
//!
//!     cargo run --release -p frisure-hairstyle --example first_head

#![expect(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;

use frisure_hairstyle::head::Head;
use frisure_hairstyle::styling::{Cut, CutLine, Dry, Operation, Wet};
use frisure_hairstyle::{
    Hairs, Hairstyle, PredictOptions, StrandOptions, StyleOptions, predict, preset,
    settling_report, strands, style,
};

/// The mean height (m) of the guides' tips.
fn mean_tip(hairstyle: &Hairstyle) -> f64 {
    let tips = hairstyle.equilibria().iter().map(|guide| guide.tip().z);
    tips.sum::<f64>() / hairstyle.equilibria().len() as f64
}

fn main() -> Result<(), Box<dyn Error>> {
    // 1. Describe: a preset, here with fewer wisps so that it is quick.
    let mut spec = preset("caucasian-curly").ok_or("no such preset")?.spec();
    spec.wisps.count = 60;
    spec.wisps.hairs = Hairs::Count(5000);
    let head = Head::mannequin();

    // 2. Predict: each guide comes to the minimum of its energy.
    let mut hair = predict(&spec, &head, PredictOptions::default(), &())?;
    let report = settling_report(&hair, &head);
    println!("{} of {} guides are at rest", report.stable, report.guides);
    println!("dry: tips at {:.1} cm", 100.0 * mean_tip(&hair));

    // 3. Style: each operation makes another hairstyle, at rest again.
    let line = CutLine::Length(0.15);
    for operation in [
        Operation::Wet(Wet::default()),
        Operation::Cut(Cut { line, ..Cut::default() }),
        Operation::Dry(Dry::default()),
    ] {
        hair = style(&hair, &head, &operation, StyleOptions::default(), &())?;
        println!("{}: tips at {:.1} cm", operation.name(), 100.0 * mean_tip(&hair));
    }

    // 4. Draw: thousands of hairs around the guides.
    let drawn = strands(&hair, &head, StrandOptions::default(), &())?.strands;
    println!("{} strands of {} points in all", drawn.len(), drawn.points().len());
    Ok(())
}
