//! Tone curves: from scene-linear light to a display's.

/// How scene-linear light becomes a display's light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneCurve {
    /// Cut off at white.
    Plain,
    /// Unchanged up to 0.55, then bent softly towards white, as film does: highlights keep their
    /// shape instead of burning out.
    #[default]
    Shoulder,
    /// A film's curve: a toe and a long shoulder (Hable 2010, *Filmic
    /// tonemapping operators*, "Uncharted 2", with white at 11.2).
    Filmic,
}

impl ToneCurve {
    /// Display-linear value (0 to 1) of a scene-linear one; not-a-number is black.
    #[must_use]
    pub fn apply(self, light: f32) -> f32 {
        // Chosen by eye.
        const KNEE: f32 = 0.55;
        let light = light.max(0.0);
        match self {
            Self::Shoulder if light > KNEE => {
                KNEE + (1.0 - KNEE) * (1.0 - ((KNEE - light) / (1.0 - KNEE)).exp())
            }
            Self::Filmic => (hable(2.0 * light) / hable(11.2)).clamp(0.0, 1.0),
            _ => light.min(1.0),
        }
    }
}

/// Hable's curve, with his constants.
fn hable(x: f32) -> f32 {
    const TOE: f32 = 0.02 / 0.30;
    if !x.is_finite() {
        return 1.0;
    }
    (x * (0.15 * x + 0.10 * 0.50) + 0.20 * 0.02) / (x * (0.15 * x + 0.50) + 0.20 * 0.30) - TOE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_film_rises_to_white_where_it_should() {
        let film = |x: f32| ToneCurve::Filmic.apply(x);
        assert!(film(0.0).abs() < 1e-6 && film(f32::NAN).abs() < 1e-6);
        assert!((film(5.6) - 1.0).abs() < 1e-6 && film(f32::INFINITY) <= 1.0);
        assert!((1..500).all(|i| film(0.01 * i as f32) > film(0.01 * (i - 1) as f32)));
    }

    #[test]
    fn the_shoulder_rises_smoothly_and_stays_below_white() {
        let curve = |i: usize| ToneCurve::Shoulder.apply(i as f32 * 0.01);
        assert_eq!(curve(50), 0.5);
        for i in 1..500 {
            let step = curve(i) - curve(i - 1);
            assert!(step > 0.0 && step < 0.010_01, "{i}: {step}");
        }
        assert!(curve(500) < 1.0);
    }
}
