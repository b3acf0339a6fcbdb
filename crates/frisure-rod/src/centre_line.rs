//! A smooth centre line through the nodes of a rod, for drawing.

use glam::DVec3;

/// A node of a rod: the end of an element, the root or the tip.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Node {
    /// Position (m, world).
    pub position: DVec3,
    /// Unit tangent, towards the tip (world).
    pub tangent: DVec3,
}

/// Largest `1 − cos θ` between neighbouring tangents that lengthens them: θ = 120°. Chosen: up to there the series for θ²
/// is within a tenth.
const SHARPEST: f64 = 1.5;

/// `count` points (m, world) of the line through evenly spaced nodes of a rod of `length` (m), from the first to the
/// last, nearly evenly along the arc.
///
/// Between nodes the line is a cubic with the nodes' tangents. These are so long that it passes through the middle of
/// an arc of a circle: `4 tan(θ/4)/θ` of the arc length, with θ the angle between them. For a sixth of a turn the
/// line is within 5e-5 of the radius then, of a helix within 3e-3.
///
/// # Panics
/// If there are fewer than two nodes, or fewer than two points.
pub fn centre_line(nodes: &[Node], length: f64, count: usize) -> impl Iterator<Item = DVec3> {
    assert!(nodes.len() > 1 && count > 1, "a line has two ends");
    let elements = nodes.len() - 1;
    let h = length / elements as f64;
    let step = elements as f64 / (count - 1) as f64;
    let mut element = usize::MAX;
    let mut cubic = [DVec3::ZERO; 4];
    (0..count).map(move |k| {
        // The element, and the fraction t of it; the cubic by Horner's rule.
        let x = (k as f64 * step).min(elements as f64);
        let i = (x as usize).min(elements - 1);
        if i != element {
            element = i;
            cubic = between(nodes[i], nodes[i + 1], h);
        }
        let t = x - i as f64;
        cubic[0] + (cubic[1] + (cubic[2] + cubic[3] * t) * t) * t
    })
}

/// Coefficients (m) of the cubic from one node to the next, h (m) farther on.
fn between(a: Node, b: Node, h: f64) -> [DVec3; 4] {
    let x = (1.0 - a.tangent.dot(b.tangent)).clamp(0.0, SHARPEST);
    // θ²/16 from θ² = 2x + x²/3 + 4x³/45 + … with x = 1 − cos θ, and with it tan(u)/u = 1 + u²/3 + 2u⁴/15 + …, u = θ/4.
    // Both are even in θ, so neither needs an arccosine or a branch for straight hair.
    let y = x * (2.0 + x * (1.0 / 3.0 + x * (4.0 / 45.0))) / 16.0;
    let speed = h * (1.0 + y * (1.0 / 3.0 + y * (2.0 / 15.0)));
    // The Hermite cubic with these tangents at both ends.
    let (from, to) = (a.tangent * speed, b.tangent * speed);
    let chord = b.position - a.position;
    [a.position, from, chord * 3.0 - from * 2.0 - to, from + to - chord * 2.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A helix of `turns` turns of the radius 1 m and a pitch of 2π `p` (m).
    fn helix(turns: f64, p: f64) -> (impl Fn(f64) -> Node, f64) {
        let speed = (1.0 + p * p).sqrt();
        let node = move |s: f64| {
            let (sin, cos) = (s / speed).sin_cos();
            Node {
                position: DVec3::new(cos, sin, p * s / speed),
                tangent: DVec3::new(-sin, cos, p) / speed,
            }
        };
        (node, turns * std::f64::consts::TAU * speed)
    }

    #[test]
    fn a_helix_of_six_nodes_a_turn_is_drawn_round() {
        for p in [0.0, 0.3, 1.0, 4.0] {
            let (on, length) = helix(3.0, p);
            let nodes: Vec<Node> = (0..=18).map(|i| on(length * f64::from(i) / 18.0)).collect();
            let points: Vec<DVec3> = centre_line(&nodes, length, 541).collect();
            for (k, point) in points.iter().enumerate() {
                let around = point.truncate().length();
                assert!(
                    (around - 1.0).abs() < if p == 0.0 { 5e-5 } else { 3e-3 },
                    "{p} {k}: {around}"
                );
                let there = on(length * k as f64 / 540.0).position;
                assert!(there.distance(*point) < 5e-3, "{p} {k}");
            }
            let drawn: f64 = points.windows(2).map(|w| w[0].distance(w[1])).sum();
            assert!((drawn / length - 1.0).abs() < 1e-3, "{p}: {drawn} of {length}");
        }
    }

    #[test]
    fn a_straight_line_is_straight_and_even() {
        let at = |i: usize| Node { position: DVec3::Z * (0.1 * i as f64), tangent: DVec3::Z };
        let nodes: Vec<Node> = (0..4).map(at).collect();
        for (k, point) in centre_line(&nodes, 0.3, 7).enumerate() {
            assert!(point.distance(DVec3::Z * (0.05 * k as f64)) < 1e-15);
        }
    }
}
