//! Kinematic hardening against its closed form at small strain; as Prager's and as no hardening at all.

use core::error::Error;

use nalgebra::Matrix3;
use piola_continuum::DeformationGradient;
use piola_inelastic::{Hardening, InelasticError, InelasticPoint, Kinematic, StepControl, Viscoplastic};
use piola_numerics::linear::matrix3::determinant;
use piola_solids::Hencky;
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use super::laws::path;
use super::paths::kinematic;

type Fallible = Result<(), Box<dyn Error>>;

/// Shear to and fro: after the inelastic shear e from χ₀ the back stress is χₛ − (χₛ − χ₀) e^(−2 c e/χₛ), χₛ = √3/(2 β), and the strain
/// is e + (k + χ)/(2 μ), k = σ₀/√3.
#[test]
fn cyclic_shear_at_small_strain_equals_the_closed_form() -> Fallible {
    let (mu, c, k, beta) = (1.0, 0.5, 1e-6, 4e5);
    let saturated = 3.0_f64.sqrt() / (2.0 * beta);
    let yield_stress = k * 3.0_f64.sqrt();
    let hardening = Hardening { yield_stress, linear: 0.0, saturation: yield_stress, saturation_exponent: 0.0 };
    let law = Kinematic::new(Hencky::new(1.0, mu)?, Hencky::new(0.0, c)?, hardening, beta, 0.0)?;
    let control = StepControl::new(1e-12)?;
    let mut point = InelasticPoint::new(&law);
    let (mut flown, mut chi) = (0.0_f64, 0.0_f64);
    for (sign, amount) in [(1.0, 3e-6), (-1.0, 5e-6), (1.0, 1e-6)] {
        // To first yield: an elastic increment is exact, and then one that flows all the way.
        let first = flown + (sign * k + chi) / (2.0 * mu);
        flown += sign * amount;
        let limit = sign * saturated;
        chi = limit - (limit - chi) * (-2.0 * c * amount / saturated).exp();
        let last = flown + (sign * k + chi) / (2.0 * mu);
        point.advance(&DeformationGradient::simple_shear(2.0 * first)?, 1.0, &control)?;
        let stress = point.advance(&DeformationGradient::simple_shear(2.0 * last)?, 1.0, &control)?.first_piola.0;
        let tol = Tol::stated(2e-5, "terms of the order of the strain, 1e-5, beside the closed form of small strain");
        assert_close("τ", &[stress[(0, 1)]], &[sign * k + chi], tol);
    }
    Ok(())
}

/// With a spring that bears next to nothing it is the solid with isotropic hardening alone.
#[test]
fn a_back_stress_of_nothing_leaves_the_viscoplastic_solid() -> Fallible {
    let hardening = Hardening { yield_stress: 0.25, linear: 0.125, saturation: 0.5, saturation_exponent: 4.0 };
    for viscosity in [0.0, 0.5] {
        let law = Kinematic::new(Hencky::new(3.0, 2.0)?, Hencky::new(0.0, 1e-14)?, hardening, 0.0, viscosity)?;
        let plain = Viscoplastic::new(Hencky::new(3.0, 2.0)?, hardening, viscosity)?;
        let (mut one, mut other) = (InelasticPoint::new(&law), InelasticPoint::new(&plain));
        for k in [0.3, -0.2] {
            let to = DeformationGradient::simple_shear(k)?;
            let a = one.advance(&to, 0.5, &StepControl::one_step())?;
            let b = other.advance(&to, 0.5, &StepControl::one_step())?;
            let tol = Tol::stated(1e-11, "a back stress of 1e-14");
            assert_close_at_scale("P", a.first_piola.0.as_slice(), b.first_piola.0.as_slice(), 1.0, tol);
            assert_close("state", &a.state[..10], &b.state, tol);
        }
    }
    Ok(())
}

/// A change of the volume neither loads nor unloads a body at its yield stress, and rounding decides whether it flows.
#[test]
fn neutral_loads_take_few_parts_and_leave_the_state() -> Fallible {
    let (law, control) = (kinematic(0.0)?, StepControl::new(1e-10)?);
    let mut point = InelasticPoint::new(&law);
    let sheared = DeformationGradient::simple_shear(0.4)?;
    let state = point.advance(&sheared, 1.0, &control)?.state;
    for factor in [1.1, 0.9, 1.3, 1.0, 1.0] {
        let to = DeformationGradient::new(sheared.matrix() * factor)?;
        let found = point.advance(&to, 1.0, &control)?;
        // Flow begins or ends eight times at most. After each the width doubles 25 times, from 5e-8 to the whole: 9 · 25 parts, and some.
        assert!(found.effort.parts < 300, "{:?}", found.effort);
        let tol = Tol::stated(1e-9, "parts of 1e-10 each, and rounding");
        assert_close_at_scale("state", &found.state, &state, 1.0, tol);
    }
    Ok(())
}

/// Follows an increment to a random deformation, and then one to the end that `turn` makes of it: the state after it against that of sixteen
/// increments with a tolerance of 1e-12 from the same beginning. The number of increments that flow.
fn check_turns(
    viscosity: f64,
    (tolerance, tol): (f64, Tol),
    turn: impl Fn(u64, &Matrix3<f64>) -> Matrix3<f64>,
) -> Result<usize, Box<dyn Error>> {
    let (law, control, fine) = (kinematic(viscosity)?, StepControl::new(tolerance)?, StepControl::new(1e-12)?);
    let mut flown = 0;
    for case in 0..u64::from(random_cases(200)) {
        let start = path(80 + case, 1)[0];
        let end = turn(case, start.matrix());
        let mut point = InelasticPoint::new(&law);
        point.advance_stress(&start, 0.5, &control)?;
        let (before, mut reference) = (*point.state(), point.clone());
        for k in 1..=16 {
            let to = start.matrix() + (end - start.matrix()) * (f64::from(k) / 16.0);
            reference.advance_stress(&DeformationGradient::new(to)?, 0.5 / 16.0, &fine)?;
        }
        point.advance_stress(&DeformationGradient::new(end)?, 0.5, &control)?;
        let what = format!("turn {case}, tolerance {tolerance:e}");
        assert_close_at_scale(&what, point.state(), reference.state(), 1.0, tol);
        flown += usize::from(before[9] < point.state()[9]);
    }
    Ok(flown)
}

/// Most turns unload the body. It stands outside the yield surface by an error of the increment before, and seems to flow at first.
#[test]
fn states_after_random_turns_equal_those_of_many_increments() -> Fallible {
    for tolerance in [1e-6, 1e-10] {
        let tol = Tol::stated(100.0 * tolerance, "the errors of some parts, and what they become");
        let flown = check_turns(0.0, (tolerance, tol), |case, _| *path(1080 + case, 1)[0].matrix())?;
        assert!(10 < flown, "{flown} increments flow");
    }
    Ok(())
}

/// The body flows on while it is unloaded, ever slower, and then no more.
#[test]
fn states_after_viscous_flow_that_ends_equal_those_of_many_increments() -> Fallible {
    // Shares of the way back to no deformation, spread by the golden section.
    let back = |case: u64, start: &Matrix3<f64>| {
        start + (Matrix3::identity() - start) * (0.05 + 0.95 * (case as f64 * 0.618).fract())
    };
    for tolerance in [1e-6, 1e-10] {
        let tol = Tol::stated(100.0 * tolerance, "the errors of some parts, and what they become");
        let flown = check_turns(0.5, (tolerance, tol), back)?;
        assert!(10 < flown, "{flown} increments flow");
    }
    Ok(())
}

/// Flow changes neither of the inelastic volumes.
#[test]
fn loads_to_and_fro_keep_the_inelastic_volumes() -> Fallible {
    let law = kinematic(0.0)?;
    let mut point = InelasticPoint::new(&law);
    for k in [0.4, -0.4, 0.5] {
        let state = point.advance(&DeformationGradient::simple_shear(k)?, 1.0, &StepControl::one_step())?.state;
        for first in [0, 10] {
            let entry = |i: usize, j: usize| state[first + 3 * i + j];
            let rows = [0, 1, 2].map(|i| [entry(i, 0), entry(i, 1), entry(i, 2)]);
            assert_close("det Fᵢ, det Fₖ", &[determinant(rows)], &[1.0], Tol::ulps(64.0));
        }
        assert!((state[10] - 1.0).abs() + state[11].abs() > 1e-3, "Fₖ evolves: {state:?}");
    }
    Ok(())
}

#[test]
fn parameters_are_refused_by_name() -> Fallible {
    let hardening = Hardening { yield_stress: 1.0, linear: 0.0, saturation: 1.0, saturation_exponent: 1.0 };
    let spring = Hencky::new(1.0, 1.0)?;
    let error = Kinematic::new(spring, spring, hardening, -1.0, 0.0);
    assert!(matches!(error, Err(InelasticError::OutOfBounds { parameter: "recovery", .. })), "{error:?}");
    let error = Kinematic::new(spring, spring, hardening, f64::NAN, 0.0);
    assert!(matches!(error, Err(InelasticError::NotFinite { quantity: "recovery", .. })), "{error:?}");
    Ok(())
}
