//! Time of the gradient of one number by many parameters: forwards and backwards in time.
//!
//! ```text
//! cargo run --release -p piola-integrators --example sensitivities
//! ```
//!
//! The field is a chain of n/2 equal oscillators with cubic springs, from rest. Its first mass is driven by a torque Σ pₖ sin(νₖ t) with m
//! coefficients. The number is the energy of the last mass at t = 20. `DormandPrince853` runs at the tolerance 1e-9. Each time is the
//! least of seven runs, over that of a run without derivatives. The adjoint method keeps ten states.

#![expect(clippy::print_stdout, reason = "the table is what this program is for")]

use core::convert::Infallible;
use std::time::Instant;

use piola_integrators::{
    AdjointSensitivity, DormandPrince853, ForwardSensitivity, IntegratorsError, JacobianProduct, Objective,
    ObjectiveGradient, ParametricField, Sensitivities, SensitivityInputs, State, Tolerance, WithParameters,
};
use piola_numerics::Real;

const MASSES: usize = 10;
const END: f64 = 20.0;
const CHECKPOINTS: usize = 10;
const RUNS: u32 = 7;

struct Chain {
    coefficients: usize,
}

impl Chain {
    /// sin(νₖ t) for all k, by rotation from one to the next.
    fn waves(t: f64) -> impl Iterator<Item = f64> {
        let (s, c) = (0.0625 * t).sin_cos();
        let mut wave = (0.0, 1.0);
        core::iter::from_fn(move || {
            wave = (wave.0 * c + wave.1 * s, wave.1 * c - wave.0 * s);
            Some(wave.0)
        })
    }
}

impl ParametricField for Chain {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        2 * MASSES
    }
    fn parameters(&self) -> usize {
        self.coefficients
    }
    fn rate<T: Real>(&self, t: f64, y: &[T], p: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        let (q, v) = y.split_at(MASSES);
        let (velocity, force) = rate.split_at_mut(MASSES);
        velocity.copy_from_slice(v);
        force.fill(T::zero());
        for (&p, wave) in p.iter().zip(Self::waves(t)) {
            force[0] += p * T::lit(wave);
        }
        let mut before = T::zero();
        for i in 0..MASSES {
            let d = q[i] - before;
            let tension = d + d * d * d;
            force[i] -= tension;
            if 0 < i {
                force[i - 1] += tension;
            }
            before = q[i];
        }
        Ok(())
    }
}

/// The chain with its product in closed form.
struct WithProduct(Chain);

impl ParametricField for WithProduct {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        self.0.dimension()
    }
    fn parameters(&self) -> usize {
        self.0.parameters()
    }
    fn rate<T: Real>(&self, t: f64, y: &[T], p: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        self.0.rate(t, y, p, rate)
    }
    fn vector_jacobian_product<T: Real>(
        &self,
        t: f64,
        y: &[T],
        _p: &[T],
        product: &mut JacobianProduct<T>,
    ) -> Result<(), Infallible> {
        let (covector, by_state, by_parameters) = product.parts();
        let (of_velocity, of_force) = covector.split_at(MASSES);
        let (by_q, by_v) = by_state.split_at_mut(MASSES);
        for (sum, &lambda) in by_v.iter_mut().zip(of_velocity) {
            *sum += lambda;
        }
        let mut before = T::zero();
        for i in 0..MASSES {
            let d = y[i] - before;
            let pulled = if 0 < i { of_force[i - 1] } else { T::zero() };
            let change = (pulled - of_force[i]) * (T::one() + T::lit(3.0) * d * d);
            by_q[i] += change;
            if 0 < i {
                by_q[i - 1] -= change;
            }
            before = y[i];
        }
        for (sum, wave) in by_parameters.iter_mut().zip(Chain::waves(t)) {
            *sum += of_force[0] * T::lit(wave);
        }
        Ok(())
    }
}

/// ½ v² of the last mass.
struct LastEnergy;
impl Objective for LastEnergy {
    fn terminal<T: Real>(&self, _t: f64, y: &[T], _p: &[T]) -> T {
        let v = y[2 * MASSES - 1];
        T::lit(0.5) * v * v
    }
}

/// The least time of the runs, s.
fn least(
    mut run: impl FnMut() -> Result<(), IntegratorsError<Infallible>>,
) -> Result<f64, IntegratorsError<Infallible>> {
    let mut least = f64::INFINITY;
    for _ in 0..RUNS {
        let clock = Instant::now();
        run()?;
        least = least.min(clock.elapsed().as_secs_f64());
    }
    Ok(least)
}

fn backwards<F: ParametricField<Error = Infallible>>(
    field: &F,
    p: &[f64],
    gradient: &mut ObjectiveGradient,
) -> Result<f64, IntegratorsError<Infallible>> {
    let tolerance = Tolerance::relative(1e-9)?;
    let mut method = AdjointSensitivity::new(DormandPrince853::new(tolerance), CHECKPOINTS);
    least(|| {
        let mut state = State::new(0.0, vec![0.0; 2 * MASSES])?;
        method.integrate_to(field, p, &mut state, END)?;
        method.gradient(field, &LastEnergy, gradient)
    })
}

fn main() -> Result<(), IntegratorsError<Infallible>> {
    let tolerance = Tolerance::relative(1e-9)?;
    println!(
        "| m | steps | replayed | run, ms | forward | adjoint, default product | adjoint, own product | difference |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for m in [5, 20, 50, 200] {
        let field = Chain { coefficients: m };
        let p: Vec<f64> = (0..m).map(|k| 0.5 / (1.0 + k as f64)).collect();
        let mut steps = 0;
        let mut plain = DormandPrince853::new(tolerance);
        let run = least(|| {
            let mut state = State::new(0.0, vec![0.0; 2 * MASSES])?;
            steps = plain.integrate_to(&mut WithParameters::new(&field, &p)?, &mut state, END)?.steps;
            Ok(())
        })?;
        let mut method = ForwardSensitivity::new(DormandPrince853::new(tolerance));
        let mut by_parameters = Vec::new();
        let forward = least(|| {
            let mut state = State::new(0.0, vec![0.0; 2 * MASSES])?;
            let mut sensitivities = Sensitivities::at_start(2 * MASSES, m, SensitivityInputs::Parameters);
            method.integrate_to(&field, &p, &mut state, &mut sensitivities, END)?;
            let v = state.values[2 * MASSES - 1];
            let row = &sensitivities.by_parameters()[(2 * MASSES - 1) * m..];
            by_parameters = row.iter().map(|x| v * x).collect();
            Ok(())
        })?;
        let mut gradient = ObjectiveGradient::default();
        let default = backwards(&field, &p, &mut gradient)?;
        let own = backwards(&WithProduct(field), &p, &mut gradient)?;
        let largest = by_parameters.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let differences = by_parameters.iter().zip(&gradient.by_parameters).map(|(a, b)| (a - b).abs());
        let difference = differences.fold(0.0, f64::max) / largest;
        println!(
            "| {m} | {steps} | {} | {:.3} | {:.1} | {:.1} | {:.1} | {difference:.1e} |",
            gradient.replayed_steps,
            1e3 * run,
            forward / run,
            default / run,
            own / run,
        );
    }
    Ok(())
}
