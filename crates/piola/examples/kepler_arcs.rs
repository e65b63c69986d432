//! All Kepler arcs between two events, with their actions: Lambert's theorem beside shooting with exact variations.
//!
//! The time and the action of an arc depend on a, r₀ + r₁ and the chord c alone, with s = ½(r₀ + r₁ + c):
//! ```text
//! t = √(a³/μ) (α − sin α − β + sin β + 2πN),    ∫ p dq = √(μa) (α + sin α − β − sin β + 2πN)
//! sin²(α/2) = s/2a,    sin(β/2) = ±√((s − c)/2a),    0 < α < 2π
//! ```
#![expect(clippy::print_stdout, reason = "an example prints")]

use core::f64::consts::TAU;

use nalgebra::Vector2;
use piola::hamiltonian::PhaseFunction;
use piola::hamiltonian::hamilton_jacobi::{Event, GeodeticDistance};
use piola::numerics::Real;

/// H = ½ p² − 1/r in the plane: μ = 1.
struct Kepler;

impl PhaseFunction for Kepler {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        T::lit(0.5) * (p[0] * p[0] + p[1] * p[1]) - (q[0] * q[0] + q[1] * q[1]).sqrt().recip()
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // From the Earth's distance to that of Mars in three and a half years: lengths in au, a year is 2π.
    let (from, to, duration) = (Vector2::new(1.0, 0.0), Vector2::new(-0.6, 1.3), 3.5 * TAU);
    let chord: f64 = (to - from).norm();
    let s: f64 = 0.5 * (from.norm() + to.norm() + chord);
    // a and β of an arc.
    let shape = |alpha: f64, way: f64| {
        let a = 0.5 * s / (0.5 * alpha).sin().powi(2);
        (a, way * 2.0 * (0.5 * (s - chord) / a).sqrt().asin())
    };
    let time = |alpha: f64, way: f64, turns: f64| {
        let (a, beta) = shape(alpha, way);
        a.powf(1.5) * (alpha - alpha.sin() - beta + beta.sin() + TAU * turns)
    };
    let (start, end) = (Event::new(from.as_slice(), 0.0), Event::new(to.as_slice(), duration));
    let mut actions = Vec::new();
    println!("way    turns         a          action G   by Lambert − 1   conjugate points");
    for (way, turns) in [1.0, -1.0].into_iter().flat_map(|way| (0..4).map(move |turns| (way, f64::from(turns)))) {
        // t(α) − t changes its sign once without a full turn, and twice or never with some.
        let late = |alpha: f64| duration < time(alpha, way, turns);
        let places = (1..4000).map(|i| TAU * f64::from(i) / 4000.0).collect::<Vec<_>>();
        for pair in places.windows(2).filter(|pair| late(pair[0]) != late(pair[1])) {
            let (mut low, mut high) = (pair[0], pair[1]);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                *(if late(middle) == late(low) { &mut low } else { &mut high }) = middle;
            }
            // The velocity at the start along the chord and along the radius, after R. H. Battin.
            let (a, beta) = shape(low, way);
            let [u, v] = [low, beta].map(|angle| (0.25 / a).sqrt() / (0.5 * angle).tan());
            let momentum = (to - from) / chord * (v + u) + from.normalize() * (v - u);
            let arc = GeodeticDistance::new(&Kepler).between(&start, &end, momentum.as_slice())?;
            // G = ∫ p dq − H dt with H = −1/2a.
            let whole = a.sqrt() * (low + low.sin() - beta - beta.sin() + TAU * turns) + 0.5 / a * duration;
            let (action, name) = (arc.distance, if 0.0 < way { "short" } else { "long " });
            let (difference, conjugate) = (action / whole - 1.0, arc.conjugate_points.len());
            println!("{name} {turns:6} {a:13.9} {action:17.12} {difference:16.1e} {conjugate:18}");
            assert!(difference.abs() < 1e-10 && (arc.initial_energy + 0.5 / a).abs() < 1e-10);
            actions.push(action);
        }
    }
    // One arc each way without a full turn, two with one and two with two; three full turns take more time.
    assert_eq!(actions.len(), 10);
    assert!(actions.iter().enumerate().all(|(i, g)| actions[..i].iter().all(|other| 1e-6 < (g - other).abs())));
    Ok(())
}
