//! Processor time, which depends less on other programs than wall time.

/// Processor time (s) of this process since an arbitrary origin; wall time if the platform has none.
#[cfg(unix)]
pub(crate) fn seconds() -> f64 {
    let now = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}

/// Processor time (s) of this process since an arbitrary origin; wall time if the platform has none.
#[cfg(not(unix))]
pub(crate) fn seconds() -> f64 {
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    START.get_or_init(std::time::Instant::now).elapsed().as_secs_f64()
}

/// Median time (s) of `runs` runs, each of which repeats the work until it has lasted `least` seconds,
/// at least once.
pub(crate) fn middle(runs: usize, least: f64, mut work: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..runs)
        .map(|_| {
            let (start, mut count) = (seconds(), 0.0);
            loop {
                work();
                count += 1.0;
                let passed = seconds() - start;
                if passed >= least {
                    return passed / count;
                }
            }
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
