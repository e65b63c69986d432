//! Equations of first order by characteristics: a wave that breaks, and light from a curved front.
#![expect(clippy::print_stdout, reason = "an example prints")]

use piola::characteristics::{CauchyProblem, FirstOrderPde, InitialManifold, ParameterInterval, Refinement};
use piola::numerics::Real;

/// ∂u/∂t + u ∂u/∂q = 0, with x = (t, q).
struct Burgers;

impl FirstOrderPde for Burgers {
    const QUASILINEAR: bool = true;
    fn value<T: Real>(&self, _x: &[T], u: T, xi: &[T]) -> T {
        xi[0] + u * xi[1]
    }
}

/// u = sin q at t = 0.
struct Sine;

impl InitialManifold for Sine {
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        (x[0], x[1]) = (T::zero(), tau[0]);
        tau[0].sin()
    }
}

/// |∇u|² = 1.
struct Eikonal;

impl FirstOrderPde for Eikonal {
    fn value<T: Real>(&self, _x: &[T], _u: T, xi: &[T]) -> T {
        xi[0] * xi[0] + xi[1] * xi[1] - T::one()
    }
}

/// u = 0 on the parabola y = x²/2, whose radius of curvature at the vertex is 1.
struct Parabola;

impl InitialManifold for Parabola {
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        (x[0], x[1]) = (tau[0], T::lit(0.5) * tau[0] * tau[0]);
        T::zero()
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The crest overtakes the trough: the wave breaks at t = 1/max(−u′) = 1, at q = π.
    let wave = [ParameterInterval { from: 0.0, to: 6.0, parts: 8 }];
    let solution = CauchyProblem::new(&Burgers, &Sine, 2)?.solve(&wave, (0.0, 1.5), Refinement::to(1e-2))?;
    let shock = solution.first_loss_of_invertibility()?.ok_or("the wave breaks")?;
    println!("the wave breaks at t = {:.12}, q = {:.12}", shock.point.s, shock.point.x[1]);
    assert!((shock.point.s - 1.0).abs() < 1e-12 && (shock.point.x[1] - core::f64::consts::PI).abs() < 1e-6);

    // Light from the vertex has travelled u = 0.75 at (0, 0.75), and is focused in the centre of curvature (0, 1).
    let light = CauchyProblem::new(&Eikonal, &Parabola, 2)?.near(&[0.0, 1.0])?;
    let caustic = light.caustic_points(&[0.0], 0.0, 1.0)?;
    println!("rays of the vertex meet at y = {:.12}", caustic[0].x[1]);
    assert!((caustic[0].x[1] - 1.0).abs() < 1e-12);
    Ok(())
}
