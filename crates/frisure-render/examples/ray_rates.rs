//! What rays cost: `ray_rates [STYLE] [STRANDS] [POINTS] [TOLERANCE_UM] [TURNS]`.
//!
//! Prints CPU seconds to build, bytes and pieces per strand, and millions of primary, bounce and shadow
//! rays per CPU second of one thread, the best of some turns. CPU time is Linux's; elsewhere it is the
//! time on the clock. Unlike the benchmarks it can be trusted on a machine that others use, if two
//! versions are run in turns.

#[path = "support/rays.rs"]
mod rays;
#[path = "support/wig.rs"]
mod wig;

use std::error::Error;
use std::fs;
use std::io::Write as _;
use std::time::Instant;

use frisure_render::accel::{CurveOptions, Ray, SceneBvh};
use rays::Rays;
use wig::Style;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let get = |i: usize, default: &str| arguments.get(i).map_or(default.to_owned(), Clone::clone);
    let style = match get(0, "curly").as_str() {
        "straight" => Style::STRAIGHT,
        "wavy" => Style::WAVY,
        _ => Style::CURLY,
    };
    let strands = wig::strands(&style, get(1, "100000").parse()?, get(2, "16").parse()?);
    let head = wig::ball();
    let default = CurveOptions::default();
    let tolerance =
        arguments.get(3).map_or(Ok(default.tolerance), |t| t.parse().map(|t: f32| 1e-6 * t))?;
    let turns: usize = get(4, "5").parse()?;
    let clock = Clock::start();
    let scene = SceneBvh::new(&strands, Some(&head), &CurveOptions { tolerance, ..default })?;
    let build = clock.all_threads();

    let rays = Rays::new(&scene);
    let met = |r: &Ray| scene.closest_hit(r, f32::INFINITY);
    let mut rates = [0.0_f64; 3];
    for _ in 0..turns {
        for (rate, rays) in rates.iter_mut().zip([&rays.primary, &rays.bounce]) {
            *rate = rate.max(measured(rays, |r| met(r).is_some()));
        }
        rates[2] = rates[2].max(measured(&rays.shadow, |r| scene.occluded(r, f32::INFINITY)));
    }
    let (n, [p, b, s]) = (strands.len().max(1), rates);
    writeln!(
        std::io::stdout().lock(),
        "build {build:.2} s, {} bytes and {:.1} pieces a strand, Mrays/s {p:.2} / {b:.3} / {s:.3}",
        scene.bytes() / n,
        scene.pieces() as f64 / n as f64,
    )?;
    Ok(())
}

/// Millions of rays per CPU second.
fn measured(rays: &[Ray], test: impl Fn(&Ray) -> bool) -> f64 {
    let clock = Clock::start();
    let hits = rays.iter().filter(|ray| test(ray)).count();
    std::hint::black_box(hits);
    1e-6 * rays.len() as f64 / clock.this_thread()
}

struct Clock {
    wall: Instant,
    this: Option<f64>,
    all: Option<f64>,
}

impl Clock {
    fn start() -> Self {
        Self { wall: Instant::now(), this: this_thread(), all: all_threads() }
    }

    fn this_thread(&self) -> f64 {
        self.since(self.this, this_thread())
    }

    fn all_threads(&self) -> f64 {
        self.since(self.all, all_threads())
    }

    fn since(&self, before: Option<f64>, now: Option<f64>) -> f64 {
        before.zip(now).map_or_else(|| self.wall.elapsed().as_secs_f64(), |(a, b)| b - a)
    }
}

/// CPU seconds of this thread.
fn this_thread() -> Option<f64> {
    let text = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse::<f64>().ok().map(|ns| 1e-9 * ns)
}

/// CPU seconds of all threads, user and system, in hundredths.
fn all_threads() -> Option<f64> {
    let text = fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = text.rsplit_once(')')?.1.split_whitespace().collect();
    let [user, system] = [11, 12].map(|i| fields.get(i)?.parse::<f64>().ok());
    Some(0.01 * (user? + system?))
}
