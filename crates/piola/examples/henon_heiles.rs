//! Order and chaos in Hénon's and Heiles's system: Poincaré sections x = 0 and the largest Lyapunov exponents.
//!
//! M. Hénon and C. Heiles, Astronomical Journal 69 (1964) 73.
#![expect(clippy::print_stdout, reason = "an example prints")]

use piola::hamiltonian::{PhaseFunction, PhasePoint, PoincareSection, lyapunov_exponents};
use piola::integrators::Tolerance;
use piola::numerics::Real;

/// H = ½(p² + q²) + x²y − y³/3: bound motions have 0 < H ≤ 1/6.
struct HenonHeiles;

impl PhaseFunction for HenonHeiles {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let (x, y) = (q[0], q[1]);
        T::lit(0.5) * (p[0] * p[0] + p[1] * p[1] + x * x + y * y) + x * x * y - y * y * y / T::lit(3.0)
    }
}

/// The surface of section x = 0.
struct Plane;

impl PhaseFunction for Plane {
    fn value<T: Real>(&self, q: &[T], _p: &[T], _t: T) -> T {
        q[0]
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    const INTERVALS: u32 = 100;
    let tolerance = Tolerance::relative(1e-10)?;
    let (interval, span) = (5.0, 5.0 * f64::from(INTERVALS));
    // Variations of a regular motion grow evenly with t, so that the estimate falls as ln t/t; chaos stays above.
    let threshold = 2.0 * span.ln() / span;
    let section = PoincareSection::new(&HenonHeiles, &Plane, tolerance);
    let mut chaotic = Vec::new();
    println!("      E   crossings   |H − E|   largest exponent   chaotic motions");
    for energy in [1.0 / 12.0, 1.0 / 8.0, 1.0 / 6.0 - 1e-9] {
        let (mut count, mut crossings, mut error, mut largest) = (0, Vec::new(), 0.0_f64, 0.0_f64);
        for y in [-0.3, -0.15, 0.0, 0.15, 0.3] {
            // From x = 0 along x: ½ p² = E − ½ y² + y³/3.
            let p: f64 = (2.0 * energy - y * y + 2.0 / 3.0 * y * y * y).sqrt();
            let start = PhasePoint::new(&[0.0, y], &[p, 0.0], 0.0)?;
            section.follow_into(&start, span, 20, &mut crossings)?;
            let found = lyapunov_exponents(&HenonHeiles, &start, 1, interval, INTERVALS as usize, tolerance)?;
            count += usize::from(threshold < found.exponents[0]);
            largest = largest.max(found.exponents[0]);
        }
        for crossing in &crossings {
            assert!(crossing.q()[0].abs() < 1e-12 && 0.0 < crossing.p()[0]); // on the surface, upwards
            error = error.max((HenonHeiles.value(crossing.q(), crossing.p(), 0.0) - energy).abs());
        }
        println!("{energy:7.4} {:11} {error:9.1e} {largest:18.4} {count:12} of 5", crossings.len());
        assert!(crossings.len() == 100 && error < 1e-8);
        chaotic.push(count);
    }
    // At 1/12 a second integral seems to hold; near the energy of escape one motion fills most of the section.
    assert!(chaotic[0] == 0 && chaotic[0] <= chaotic[1] && 3 <= chaotic[2], "{chaotic:?}");
    Ok(())
}
